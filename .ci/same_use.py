"""What people rely on, run in one checkout and compared with what it did in another.

python .ci/same_use.py write CHECKOUT FILE.json [PAGES]   pages: the checkout whose README and examples are run
python .ci/same_use.py compare OLD.json NEW.json          exit status 1 where an exit status or a result differs
"""

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parents[1]
TIMES = re.compile(r"\b\d[\d.,]*(?:e[-+]?\d+)?\s?(?:ms|s|min|kB|MB|GB)\b")
SECONDS = {"seconds", "solve_seconds", "cost_s", "created", "version"}
COMMANDS = [
    "cases",
    "scene table_14_1",
    "scene nowhere",
    "compare table_14_1",
    "compare rail --quantity contact-filter,equivalent-roughness --csv out.csv --json out.json",
    "compare rail --models springs,linear --tolerance 20%",
    "compare rail --tolerance 20",
    "compare rough_punch --models mdr,bem --json out.json --figure out.svg",
    "compare table_14_1 --all --json out.json --report page",
    "compare table_14_1 --models mdr --sweep wheel.load=40kN,50kN --workers 1 --json out.json",
    "compare rail --cnossos out.csv --json out.json",
    "compare nowhere.toml",
    "sound rail --seconds 0.5 --out sounds",
    "report --only hertz geike --out made --workers 1",
    "report --only hertz --keep --out made --workers 2",
    "report --only geike --seed 7 --out other",
    "report --scene table_14_1 --out scene",
    "report --only nowhere",
    "report --only hertz --executor dask://127.0.0.1:1 --out lost",
    "report --only hertz --keep --out nowhere",
    "calibrate --show --workers 2",
]


def write(checkout: Path, target: Path, pages: Path) -> None:
    """Run all in an empty folder; keep exit statuses, what is printed without times, and files of results."""
    found: dict[str, Any] = {}
    environment = {**os.environ, "PYTHONPATH": str(checkout), "OMP_NUM_THREADS": "1", "COLUMNS": "120"}
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        for words in COMMANDS:
            command = [sys.executable, "-m", "validation", *words.split()]
            found[words] = _ran(command, scratch, environment)
            if (scratch / "out.json").exists():
                found[words]["json"] = _without_seconds(json.loads((scratch / "out.json").read_text(encoding="utf-8")))
                (scratch / "out.json").unlink()
            print(found[words]["status"], words, flush=True)
        for script in sorted((pages / "validation" / "examples").glob("*.py")):
            found[script.name] = _ran([sys.executable, str(script)], scratch, environment)
            print(found[script.name]["status"], script.name, flush=True)
        for page in ("README.md", "CONTRIBUTING.md", "reports/docs/two_methods.md"):
            text = (pages / page).read_text(encoding="utf-8")
            for i, code in enumerate(re.findall(r"```python\n(.*?)```", text, flags=re.DOTALL)):
                found[f"{page} {i}"] = _ran([sys.executable, "-c", code], scratch, environment)
                print(found[f"{page} {i}"]["status"], page, i, flush=True)
        found["killed"] = _killed_and_resumed(scratch, environment)
        found["redraw"] = _redrawn(scratch / "made", environment)
    target.write_text(json.dumps(found, indent=1), encoding="utf-8")


def _ran(command: list[str], folder: Path, environment: dict[str, str]) -> dict[str, Any]:
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, encoding="utf-8", timeout=900)
    return {"status": done.returncode, "printed": TIMES.sub("TIME", done.stdout), "said": done.stderr[-2000:]}


def _without_seconds(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _without_seconds(one) for name, one in value.items() if name not in SECONDS}
    return [_without_seconds(one) for one in value] if isinstance(value, list) else value


def _killed_and_resumed(folder: Path, environment: dict[str, str]) -> dict[str, Any]:
    """kill -9 in the middle; the same command reads what was finished, and says how much time is left."""
    command = [sys.executable, "-m", "validation", "report", "--only", "rolling", "--out", "killed", "--workers", "2"]
    run = subprocess.Popen(command, cwd=folder, env=environment, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    store = folder / "killed" / "realisations"
    while run.poll() is None and len(list(store.glob("*.npz"))) < 3:
        time.sleep(0.05)
    run.send_signal(signal.SIGKILL)
    run.wait()
    kept = len(list(store.glob("*.npz")))
    again = subprocess.run(command, cwd=folder, env=environment, capture_output=True, encoding="utf-8", timeout=900)
    return {"status": again.returncode, "finished before": kept >= 3}


def _redrawn(folder: Path, environment: dict[str, str]) -> dict[str, Any]:
    """The line under each figure, as the pages print it."""
    pages = "".join(page.read_text(encoding="utf-8") for page in folder.glob("*.html"))
    lines = {line.replace("&#34;", '"') for line in re.findall(r"<code>(from validation.*?)</code>", pages)}
    return {"status": max(_ran([sys.executable, "-c", line], folder, environment)["status"] for line in lines)}


def compare(old: Path, new: Path) -> bool:
    """Whether exit statuses and results are equal; what is printed otherwise is shown."""
    was, now = (json.loads(path.read_text(encoding="utf-8")) for path in (old, new))
    wrong = [name for name in was if was[name]["status"] != now[name]["status"]]
    other = [name for name in was if not _has(now[name].get("json"), was[name].get("json"))]
    for name in wrong:
        print(f"status {was[name]['status']} -> {now[name]['status']}: {name}\n{now[name].get('said', '')[-600:]}")
    for name in other:
        print(f"another result: {name}")
    for name in was:
        if was[name].get("printed") != now[name].get("printed"):
            print(f"printed otherwise: {name}")
    print(f"{len(was)} uses, {len(wrong)} with another exit status, {len(other)} with another result")
    return not wrong and not other


def _has(new: Any, old: Any) -> bool:
    """Whether all keys and values of the old one are there; new keys may stand beside them."""
    if isinstance(old, dict) and isinstance(new, dict):
        return all(name in new and _has(new[name], value) for name, value in old.items())
    if isinstance(old, list) and isinstance(new, list):
        return len(old) == len(new) and all(map(_has, new, old))
    return bool(old == new)


if __name__ == "__main__":
    command, *rest = sys.argv[1:]
    if command == "write":
        checkout, target, *pages = map(Path, rest)
        write(checkout.resolve(), target, pages[0] if pages else HERE)
    else:
        sys.exit(0 if compare(*map(Path, rest)) else 1)
