"""A study's folder as versions before 0.2 left it: parts that do not say whose they are, and a ledger without checksums."""

import sqlite3

from pyarrow import parquet

LEDGER = """
create table identity (key text primary key, value text not null);
create table parts (first integer primary key, count integer not null, name text not null unique, seconds real not null);
create table remarks (text text primary key);
"""


def make_older(folder, change=lambda table: table):
    """Rewrite a study; `change(table)` is done to every part."""
    for file in (folder / "parts").glob("*.parquet"):
        parquet.write_table(change(parquet.read_table(file).replace_schema_metadata(None)), file)
    ledger = sqlite3.connect(folder / "ledger.sqlite")
    rows = {table: ledger.execute(f"select * from {table}").fetchall() for table in ("identity", "remarks")}
    rows["parts"] = ledger.execute("select first, count, name, seconds from parts").fetchall()
    ledger.close()
    (folder / "ledger.sqlite").unlink()
    ledger = sqlite3.connect(folder / "ledger.sqlite")
    ledger.executescript(LEDGER)
    for table, lines in rows.items():
        if lines:
            ledger.executemany(f"insert into {table} values ({', '.join('?' * len(lines[0]))})", lines)
    ledger.commit()
    ledger.close()
