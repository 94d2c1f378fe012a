"""Builds the wheel, makes it independent of the system's libraries, and renders with it where nothing else is.

usage: wheel.py SOURCE BUILD PROGRAM

SOURCE is the checkout, BUILD a folder for what is made, PROGRAM the wend program whose picture must be the same bits.
What runs are the README's lines of Python. As root, they run in a folder that holds Python and the C and C++
libraries alone (chroot); otherwise in an environment of its own. Ends with status 77 where auditwheel is absent.
"""

import glob
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path


def lines_of_readme(source: Path) -> str:
    """What the README shows of Python, by samples in place of time, and a short comparison; it writes demo.exr."""
    blocks = re.findall(r"```python\n(.*?)```", (source / "README.md").read_text(), re.DOTALL)
    (block,) = (block for block in blocks if "demo.exr" in block)
    for shown, quick in (("time=10", "spp=3"), ("time=5", "time=0.1")):
        if block.count(shown + ")") + block.count(shown + ",") != 1:
            raise SystemExit(f"the README's lines of Python have no {shown}")
        block = block.replace(shown, quick)
    return block


def run(*command: object, **options: object) -> str:
    print("+", *command, flush=True)
    return subprocess.run([str(c) for c in command], check=True, stdout=subprocess.PIPE, text=True, **options).stdout


def make_wheel(source: Path, build: Path) -> Path:
    for old in build.glob("*/*.whl"):
        old.unlink()
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check"]
    run(*pip, "wheel", source, "--no-build-isolation", "--no-deps", "-w", build / "raw", "-C",
        f"build-dir={build}", "-C", "cmake.define.WEND_WARNINGS_AS_ERRORS="
        + os.environ.get("WEND_WARNINGS_AS_ERRORS", "OFF"))
    (raw,) = (build / "raw").glob("wend-*.whl")
    run(sys.executable, "-m", "auditwheel", "repair", raw, "-w", build / "dist", "--strip",
        env=os.environ | {"PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"})
    (wheel,) = (build / "dist").glob("wend-*manylinux*.whl")
    run(*pip, "install", "--quiet", "--upgrade", "--target", build / "site", "--no-deps", wheel)
    run(*pip, "install", "--quiet", "--upgrade", "--target", build / "site", "numpy")
    return wheel


def libraries_of(files: list[str]) -> set[str]:
    found = set()
    for file in files:
        listed = subprocess.run(["ldd", file], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
        found.update(re.findall(r"(/\S+) \(0x", listed))
    return found


def bare_system(folder: Path, site: Path) -> None:
    """Python, what it is linked with, and the packages: no other file."""
    shutil.rmtree(folder, ignore_errors=True)
    prefix = Path(sys.base_prefix)
    python = Path(os.path.realpath(sys.executable))
    standard = Path(sysconfig.get_paths()["stdlib"])
    extensions = glob.glob(str(standard / "lib-dynload" / "*.so"))
    # What every system has, so that no wheel brings it: the C library, in its parts, and the C++ library.
    native = libraries_of(glob.glob(str(site / "wend" / "_wend*.so")))
    runtime = {name for name in native if re.match(r"lib(stdc\+\+|gcc_s|c)\.so|ld-linux", Path(name).name)}
    (c_library,) = (Path(name) for name in runtime if Path(name).name.startswith("libc.so"))
    parts = ("libdl.so.2", "libm.so.6", "libpthread.so.0", "librt.so.1", "libutil.so.1")
    runtime |= {str(c_library.with_name(part)) for part in parts if c_library.with_name(part).exists()}
    for library in libraries_of([str(python), *extensions]) | runtime:
        target = folder / library.lstrip("/")
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(library, target)
    (folder / "python").mkdir(parents=True, exist_ok=True)
    target = folder / str(prefix).lstrip("/")
    (target / "bin").mkdir(parents=True, exist_ok=True)
    shutil.copy2(python, target / "bin" / "python")
    shutil.copytree(standard, folder / str(standard).lstrip("/"), dirs_exist_ok=True,
                    ignore=shutil.ignore_patterns("site-packages", "test", "__pycache__", "config-*"))
    shutil.copytree(site, folder / "site")


def main() -> int:
    source, build, program = (Path(argument).resolve() for argument in sys.argv[1:])
    if importlib.util.find_spec("auditwheel") is None or shutil.which("ldd") is None:
        print("skipped: auditwheel is absent")
        return 77
    build.mkdir(parents=True, exist_ok=True)
    wheel = make_wheel(source, build)
    print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.1f} MB")
    expected, found = build / "program.exr", build / "wheel.exr"
    run(program, "render", source / "scenes" / "demo.pbrt", "--spp", "3", "-o", expected, "--quiet")
    lines = lines_of_readme(source)
    if os.geteuid() == 0:
        system = build / "system"
        bare_system(system, build / "site")
        run(shutil.which("chroot"), system, Path(sys.base_prefix) / "bin" / "python", "-c", lines,
            env={"PYTHONPATH": "/site", "PYTHONHOME": sys.base_prefix})
        shutil.move(system / "demo.exr", found)
        shutil.rmtree(system)
    else:
        run(sys.executable, "-c", lines, env={"PYTHONPATH": str(build / "site")}, cwd=build)
        shutil.move(build / "demo.exr", found)
    compare = (
        "import sys, numpy, wend; a, b = map(wend.read, sys.argv[1:]);"
        "sys.exit(0 if all(numpy.array_equal(a[name], b[name]) for name in a) else 'other bits than the program')"
    )
    run(sys.executable, "-c", compare, expected, found, env={"PYTHONPATH": str(build / "site")})
    print("the same bits as the program")
    return 0


if __name__ == "__main__":
    sys.exit(main())
