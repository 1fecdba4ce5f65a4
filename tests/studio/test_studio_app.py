"""The studio's server as a process: what it serves to whom, what it says when it cannot, and that nothing is left of it."""

import http.client
import json
import os
import re
import signal
import socket
import subprocess
import sys
import time
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from types import SimpleNamespace
from urllib.parse import urlsplit

import pytest
from places import EXAMPLES

from drivewright.cli import main
from drivewright.studio.access import COOKIE, LARGEST

pytestmark = [pytest.mark.interface, pytest.mark.needs_studio]

SPEC = EXAMPLES / "four_bar.toml"
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


@contextmanager
def started(*launches):
    """The servers of [(folder, command, options)], all at once, as soon as they have said their addresses; `said()` is all they say."""
    servers = [_launched(*launch) for launch in launches]
    try:
        for server in servers:
            server.address = urlsplit(_waited(lambda server=server: re.search(r"http://\S+", server.said()), server.process)[0])
            server.port = server.address.port
        yield servers
    finally:
        for server in servers:
            server.process.terminate()
        for server in servers:
            try:
                server.process.wait(10)
            except subprocess.TimeoutExpired:
                server.process.kill()
                server.process.wait()


def _launched(folder, command, *options):
    text = folder / "stderr.txt"
    environment = {**os.environ, "TMPDIR": str(folder), "PYTHONIOENCODING": "utf-8"}
    with text.open("wb") as stderr:
        process = subprocess.Popen([*command, "studio", str(SPEC), "--port", "0", "--no-browser", *options], stderr=stderr, env=environment)
    return SimpleNamespace(folder=folder, process=process, said=lambda: text.read_text(encoding="utf-8"))


def _waited(condition, process, seconds=60):
    deadline = time.monotonic() + seconds
    while not (found := condition()):
        assert process.poll() is None and time.monotonic() < deadline
        time.sleep(0.02)
    return found


@pytest.fixture(scope="module")
def servers(tmp_path_factory):
    offering = (sys.executable, "-c", OFFERING)
    with started(
        (tmp_path_factory.mktemp("here"), COMMAND),
        (tmp_path_factory.mktemp("elsewhere"), offering, "--host", "0.0.0.0", "--token", "open-sesame"),
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
    cookie = f"{COOKIE}-{elsewhere.port}=open-sesame"
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
    assert ask(here, Host="evil.example")[0] == 421
    assert ask(here, Host=f"localhost:{here.port}")[0] == 200


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
    assert elsewhere.address.query == "token=open-sesame"
    assert elsewhere.address.hostname == socket.gethostname().lower()  # 0.0.0.0 is no address to go to
    assert ask(elsewhere, "/healthz")[0] == 200
    status, _, body = ask(elsewhere)
    assert status == 401 and b"open the address that the command printed" in body
    assert ask(elsewhere, "/?token=open-sesam")[0] == 401
    status, headers, _ = ask(elsewhere, "/?token=open-sesame")
    assert (status, headers["Location"]) == (303, "/")
    cookie = headers["Set-Cookie"].partition(";")[0]
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


def below(pid):
    """Ids of all processes that a process has started, and theirs."""
    parents = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:  # gone meanwhile
            continue
        if fields[0] != "Z":
            parents[int(stat.parent.name)] = int(fields[1])
    found, fresh = set(), {pid}
    while fresh:
        fresh = {child for child, parent in parents.items() if parent in fresh} - found
        found |= fresh
    return found


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="counts processes in /proc")
def test_a_signal_ends_it_and_leaves_nothing_behind(tmp_path_factory):
    signals = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)
    with started(*((tmp_path_factory.mktemp("end"), COMMAND) for _ in signals)) as all_of_them:
        for server, number in zip(all_of_them, signals, strict=True):
            children = _waited(lambda server=server: len(found := below(server.process.pid)) > 1 and found, server.process)
            server.process.send_signal(number)
            code = server.process.wait(8)
            _ended(children)
            assert code in (0, -number, 128 + number) and "Traceback" not in server.said()
            assert number == signal.SIGKILL or [path.name for path in server.folder.iterdir()] == ["stderr.txt"]
            with pytest.raises(OSError):
                ask(server, "/healthz")


def _ended(processes):
    deadline = time.monotonic() + 5
    while left := [pid for pid in processes if Path(f"/proc/{pid}").exists()]:
        assert time.monotonic() < deadline, left
        time.sleep(0.05)
