"""The studio's server as a process: what it serves to whom, what it says when it cannot, and that nothing is left of it."""

import http.client
import json
import re
import signal
import socket
import sys
import time
from contextlib import closing, suppress
from pathlib import Path

import pytest
from places import EXAMPLES
from studio_server import SPEC, below, started, waited

from drivewright.cli import main
from drivewright.studio.access import COOKIE, LARGEST

pytestmark = [pytest.mark.interface, pytest.mark.needs_studio]

TOKEN = "open-sesame-and-more"
COMMAND = (sys.executable, "-m", "drivewright")
# The same command, with a file that waits to be fetched.
OFFERING = """
import sys
from drivewright import cli
from drivewright.studio import app

class Offering(app.ServerResources):
    def __init__(self):
        super().__init__()
        print(self.offer('my "cäm".dxf', bytes([0, 255])), file=sys.stderr, flush=True)

app.ServerResources = Offering
sys.exit(cli.main())
"""


@pytest.fixture(scope="module")
def servers(tmp_path_factory):
    offering = (sys.executable, "-c", OFFERING)
    with started(
        (tmp_path_factory.mktemp("here"), COMMAND), (tmp_path_factory.mktemp("elsewhere"), offering, "--host", "0.0.0.0", "--token", TOKEN)
    ) as both:
        yield both


@pytest.fixture(scope="module")
def here(servers):
    return servers[0]


@pytest.fixture(scope="module")
def elsewhere(servers):
    return servers[1]


def ask(server, path="/", **headers):
    """(status, headers, body) of the answer."""
    with closing(http.client.HTTPConnection("127.0.0.1", server.port, timeout=30)) as connection:
        connection.request("GET", path, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.headers, b"" if answer.status == 101 else answer.read()


def entered(server):
    """The cookie that the token is worth."""
    status, headers, _ = ask(server, f"/?token={TOKEN}")
    assert (status, headers["Location"]) == (303, "/")
    cookie, *flags = headers["Set-Cookie"].split("; ")
    assert cookie.startswith(f"{COOKIE}-{server.port}=") and set(flags) == {"HttpOnly", "SameSite=Strict", "Path=/"}
    return cookie


# -- what it serves ------------------------------------------------------------------------------------------------------------


def test_it_is_well_and_says_where_it_is(here):
    assert ask(here, "/healthz")[::2] == (200, b'{"status":"ok"}')
    assert here.port not in range(8123, 8143)  # port 0 is any free one
    assert here.said() == f"Drivewright studio: http://127.0.0.1:{here.port}/  (Ctrl-C ends it)\n"


def test_the_page_names_our_modules_only(here):
    status, headers, body = ask(here)
    assert status == 200 and headers.get_content_type() == "text/html"
    text = body.decode()
    assert "<title>Drivewright studio</title>" in text and '<link rel="stylesheet" href="/web/studio.css">' in text
    assert not re.search(r"""(?:src|href)=["'](?:https?:)?//""", text)  # nothing from outside


def test_the_page_runs_its_own_scripts_only_and_nowhere_else(here):
    nonces = set()
    for _ in range(2):
        _, headers, body = ask(here)
        policy = dict(part.strip().partition(" ")[::2] for part in headers["Content-Security-Policy"].split(";"))
        assert policy["default-src"] == policy["frame-ancestors"] == policy["base-uri"] == policy["form-action"] == "'none'"
        assert "'unsafe-inline'" not in headers["Content-Security-Policy"] and "http" not in headers["Content-Security-Policy"]
        (nonce,) = re.findall(r"'nonce-([\w-]{20,})'", policy["script-src"])
        text = body.decode()
        assert re.findall(rf"<(?:script|style)\b(?! nonce=\"{nonce}\")", text) == []
        assert not re.search(r"<[^>]* (?:style|on\w+)=", re.sub(r"(?s)<(script|style).*?</\1>", "", text))
        nonces.add(nonce)
    assert len(nonces) == 2  # a new one each time
    for path in ("/web/main.js", "/healthz", "/nothing"):
        headers = ask(here, path)[1]
        assert (
            headers["Content-Security-Policy"].startswith("default-src 'none'")
            and "frame-ancestors 'none'" in headers["Content-Security-Policy"]
        )
        assert headers["X-Frame-Options"] == "DENY" and headers["Cross-Origin-Resource-Policy"] == "same-origin"


@pytest.mark.parametrize(
    ("name", "kind", "source"),
    [
        ("player.js", "text/javascript", "report/player.js"),
        ("plots.js", "text/javascript", "report/plots.js"),
        ("main.js", "text/javascript", "studio/web/main.js"),
        ("player.css", "text/css", "report/player.css"),
        ("studio.css", "text/css", "studio/web/studio.css"),
        ("mark.svg", "image/svg+xml", "studio/web/mark.svg"),
    ],
)
def test_modules_come_with_their_type_and_are_not_guessed_at(here, name, kind, source):
    status, headers, body = ask(here, f"/web/{name}")
    assert (status, headers.get_content_type(), headers["X-Content-Type-Options"]) == (200, kind, "nosniff")
    assert headers["Cache-Control"] == "no-cache"
    assert body == (EXAMPLES.parent / "src" / "drivewright" / source).read_bytes()


@pytest.mark.parametrize(
    "path",
    [
        "/web/",
        "/web/nothing.js",
        "/web/../app.py",
        "/web/%2e%2e/app.py",
        "/web/..%2fapp.py",
        "/web/..%5capp.py",
        "/web//etc/passwd",
        "/web/%2fetc%2fpasswd",
        "/web/player.js%00.css",
        "/web/app.py",
        "/web/PLAYER.JS",
        "/download/",
        "/download/x",
        "/download/..%2fx",
        "/docs",
        "/redoc",
        "/openapi.json",
        "/elsewhere",
    ],
)
def test_there_is_nothing_else(here, path):
    status, _, body = ask(here, path)
    assert status == 404 and b"The studio's server" not in body and b"root:" not in body


def test_a_file_is_fetched_once_and_is_only_saved(elsewhere):
    (path,) = re.findall(r"^/download/\S+$", elsewhere.said(), re.MULTILINE)
    cookie = entered(elsewhere)
    assert ask(elsewhere, path)[0] == 401  # which takes nothing away
    status, headers, body = ask(elsewhere, path, Cookie=cookie)
    assert (status, body) == (200, bytes([0, 255]))
    assert headers.get_content_type() == "application/octet-stream" and headers["X-Content-Type-Options"] == "nosniff"
    assert headers["Content-Disposition"] == "attachment; filename=\"my-c_m-.dxf\"; filename*=UTF-8''my-c%C3%A4m-.dxf"
    status, _, body = ask(elsewhere, path, Cookie=cookie)
    assert status == 404 and b"ask for it again" in body


# -- whom it serves ------------------------------------------------------------------------------------------------------------

SOCKET = {"Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13", "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ=="}
SOCKET_PATH = "/_nicegui_ws/socket.io/?EIO=4&transport=websocket"


def test_another_name_for_this_machine_is_refused(here):
    for host in ("evil.example", f"a@127.0.0.1:{here.port}", f"evil.example@127.0.0.1:{here.port}", f"127.0.0.1:{here.port}@evil.example"):
        assert ask(here, Host=host)[0] == 421
        assert ask(here, SOCKET_PATH, **SOCKET, Host=host)[0] == 403  # which is how a server refuses a websocket
    assert ask(here, Host=f"localhost:{here.port}")[0] == 200


@pytest.mark.parametrize("path", ["/", SOCKET_PATH])
@pytest.mark.parametrize("name", ["Host", "Origin"])
def test_a_header_that_names_the_place_twice_is_refused(here, path, name):
    value = f"127.0.0.1:{here.port}" if name == "Host" else f"http://127.0.0.1:{here.port}"
    head = [f"{name}: {value}"] * 2 + ([f"Host: 127.0.0.1:{here.port}"] if name == "Origin" else [])
    head += [f"{key}: {text}" for key, text in SOCKET.items()] if path == SOCKET_PATH else []
    assert raw(here, f"GET {path} HTTP/1.1\r\n" + "\r\n".join(head) + "\r\n\r\n").split()[1] in (
        [b"400"] if path == "/" else [b"400", b"403"]
    )


def raw(server, text, wait=5):
    """What the server says to some bytes, until it closes the connection or says nothing more."""
    with closing(socket.create_connection(("127.0.0.1", server.port), timeout=wait)) as connection:
        connection.sendall(text if isinstance(text, bytes) else text.encode())
        return connection.recv(65536)


def test_a_page_of_another_site_is_refused(here):
    own = f"http://127.0.0.1:{here.port}"
    assert ask(here, "/web/main.js", Origin="http://evil.example")[0] == 403
    assert ask(here, "/web/main.js", Origin=own)[0] == 200
    assert ask(here, SOCKET_PATH, Origin="http://evil.example", **SOCKET)[0] == 403
    assert ask(here, SOCKET_PATH, Origin=own, **SOCKET)[0] == 101


def test_a_large_body_is_refused_whatever_it_promises(here):
    large = b"x" * (LARGEST + 1)
    path = "/_nicegui_ws/socket.io/?EIO=4&transport=polling"
    assert _posted(here, path, large, {"Content-Length": str(len(large))}) == 413
    assert ask(here, "/healthz")[0] == 200


def test_a_large_body_in_pieces_is_refused_too(here):
    path = "/_nicegui_ws/socket.io/?EIO=4&transport=polling"
    number = json.loads(ask(here, path)[2][1:])["sid"]  # of a connection, so that somebody reads the body
    piece = b"x" * 100_000
    raw = (f"{len(piece):x}\r\n".encode() + piece + b"\r\n") * (LARGEST // len(piece) + 1) + b"0\r\n\r\n"
    assert _posted(here, f"{path}&sid={number}", raw, {"Transfer-Encoding": "chunked"}) == 413
    assert ask(here, "/healthz")[0] == 200


def _posted(server, path, raw, headers):
    """Status of a POST whose answer may come before all of the body is sent."""
    head = "".join(f"{name}: {value}\r\n" for name, value in {"Host": f"127.0.0.1:{server.port}", **headers}.items())
    with closing(socket.create_connection(("127.0.0.1", server.port), timeout=30)) as connection:
        connection.sendall(f"POST {path} HTTP/1.1\r\n{head}\r\n".encode())
        with suppress(OSError):
            connection.sendall(raw)
        return int(connection.recv(4096).split()[1])


def test_others_need_the_token_of_the_address(elsewhere):
    assert elsewhere.address.query == f"token={TOKEN}"
    assert elsewhere.address.hostname == socket.gethostname().lower()  # 0.0.0.0 is no address to go to
    assert ask(elsewhere, "/healthz")[0] == 200
    status, _, body = ask(elsewhere)
    assert status == 401 and b"open the address that the command printed" in body
    assert ask(elsewhere, f"/?token={TOKEN[:-1]}")[0] == 401
    assert ask(elsewhere, Cookie=f"{COOKIE}-{elsewhere.port}={TOKEN}")[0] == 401  # the cookie is not the token
    cookie = entered(elsewhere)
    assert ask(elsewhere, Cookie=cookie)[0] == 200
    assert ask(elsewhere, Cookie=cookie, Host="workstation.example")[0] == 200
    assert ask(elsewhere, SOCKET_PATH, **SOCKET)[0] == 403
    assert ask(elsewhere, SOCKET_PATH, Cookie=cookie, **SOCKET)[0] == 101


# -- when it cannot begin ------------------------------------------------------------------------------------------------------


def refused(capsys, *options, spec=SPEC):
    """What the command says and returns where nothing is served."""
    with pytest.raises(SystemExit) as end:
        main(["studio", str(spec), "--no-browser", *options])
    return end.value.code, capsys.readouterr().err


def test_a_port_that_is_taken(here, capsys):
    code, said = refused(capsys, "--port", str(here.port))
    assert code == 2
    assert (
        f"studio: 127.0.0.1, port {here.port}: cannot listen there (taken, or not allowed); "
        "choose another --port, or --host of this machine"
    ) in re.sub(r"\s+", " ", said)


@pytest.mark.parametrize("token", ["x", "fifteen letters", "sixteen letters\N{LATIN SMALL LETTER E WITH ACUTE}", "sixteen letters\n"])
@pytest.mark.parametrize("host", ["127.0.0.1", "0.0.0.0"])
def test_a_token_that_could_be_guessed(capsys, token, host):
    code, said = refused(capsys, "--host", host, "--port", "0", "--token", token)
    assert code == 2 and f"--token has {len(token)} characters; it needs at least 16" in re.sub(r"\s+", " ", said)


@pytest.mark.parametrize("options", [("--host", "192.0.2.1"), ("--port", "70000"), ("--port", "-1"), ("--host", "no.such.host.invalid")])
def test_where_nobody_can_listen(capsys, options):
    code, said = refused(capsys, *options)
    assert code == 2 and "cannot listen there" in said


def test_a_file_that_is_not_there(capsys, tmp_path):
    code, said = refused(capsys, spec=tmp_path / "nothing.toml")
    assert code == 2 and "nothing.toml" in said and "Traceback" not in said


def test_a_spec_with_an_error_in_the_words_of_the_command_line(capsys, tmp_path):
    spec = tmp_path / "wrong.toml"
    spec.write_text(re.sub(r'(?m)^speed = ".*"', 'speed = "3 kg"', SPEC.read_text(encoding="utf-8")), encoding="utf-8")
    code, said = refused(capsys, spec=spec)
    assert code == 2 and "drive.speed: wants an angular speed, got '3 kg' (mass)" in re.sub(r"\s+", " ", said)
    with pytest.raises(SystemExit):
        main(["run", str(spec)])
    assert capsys.readouterr().err == said


# -- the end -------------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="counts processes in /proc")
def test_a_signal_ends_it_and_leaves_nothing_behind(tmp_path_factory):
    signals = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)
    with started(*((tmp_path_factory.mktemp("end"), COMMAND) for _ in signals)) as all_of_them:
        for server, number in zip(all_of_them, signals, strict=True):
            children = waited(lambda server=server: len(found := below(server.process.pid)) > 1 and found, server.process)
            server.process.send_signal(number)
            code = server.process.wait(60)
            _ended(children)
            assert code in (0, -number, 128 + number) and "Traceback" not in server.said()
            assert number == signal.SIGKILL or [path.name for path in server.folder.iterdir()] == ["stderr.txt"]
            with pytest.raises(OSError):
                ask(server, "/healthz")


def _ended(processes):
    deadline = time.monotonic() + 30
    while left := [pid for pid in processes if Path(f"/proc/{pid}").exists()]:
        assert time.monotonic() < deadline, left
        time.sleep(0.05)
