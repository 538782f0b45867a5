"""Types into shells under a terminal and reads the completions: check-completion.py BIN FOLDER"""

import os
import pty
import re
import select
import shutil
import subprocess
import sys
import time

bin_folder, folder = sys.argv[1:3]
passed = failed = skipped = 0


def read_until(terminal, wanted, seconds):
    """What comes, until `wanted` is in it or the time is over."""
    text, end = "", time.time() + seconds
    while time.time() < end and not re.search(wanted, text):
        if select.select([terminal], [], [], 0.2)[0]:
            try:
                text += os.read(terminal, 65536).decode("utf-8", "replace")
            except OSError:
                break
    return text


def in_shell(argv, prepare, typed, wanted):
    """The output of a shell after keys were typed at its prompt."""
    pid, terminal = pty.fork()
    if pid == 0:
        os.chdir(folder)
        os.environ.update(
            PATH=bin_folder + ":" + os.environ["PATH"], TERM="xterm", HOME=folder,
            XDG_CONFIG_HOME=folder, COLUMNS="200", LINES="60",
        )
        os.execvp(argv[0], argv)
    os.write(terminal, (prepare + "; echo rea''dy\n").encode())
    read_until(terminal, r"[^\w']ready", 60)
    time.sleep(0.5)
    os.write(terminal, typed.encode())
    text = read_until(terminal, wanted, 30)
    os.write(terminal, b"\x03\x04")
    os.close(terminal)
    try:
        os.kill(pid, 9)
    except ProcessLookupError:
        pass
    os.waitpid(pid, 0)
    return text


shells = {
    "bash": (["bash", "--norc", "--noprofile", "-i"],
             "bind 'set bell-style none'; . ./completion.bash"),
    "zsh": (["zsh", "-f", "-i"], "autoload -Uz compinit; compinit -u; . ./completion.zsh"),
    "fish": (["fish", "--private", "-i"], "source completion.fish"),
}
# What is typed, and what must appear. A unique beginning is completed by one tab.
cases = [
    ("a verb", "rotdyn traj\t", r"rotdyn traj\S*ectory|ectory"),
    ("an option", "rotdyn roll --gra\t", r"vity-m-per-s2"),
    ("values of an option", "rotdyn roll --format \t\t", r"jsonl"),
    ("a model", "rotdyn audit --model free_gy\t", r"rostat"),
    ("a shape", "rotdyn inertia regular_tet\t", r"rahedron"),
    ("a file", "rotdyn audit --torque-file mot\t", r"or\.csv"),
]

open(os.path.join(folder, "motor.csv"), "w").close()
for shell, (argv, prepare) in shells.items():
    if not shutil.which(shell):
        print(f"skip - {shell} is not installed")
        skipped += 1
        continue
    path = os.path.join(folder, f"completion.{shell}")
    with open(path, "w") as file:
        subprocess.run([os.path.join(bin_folder, "rotdyn"), "completion", shell], stdout=file,
                       check=True)
    for what, typed, wanted in cases:
        text = in_shell(argv, prepare, typed, wanted)
        if re.search(wanted, text):
            print(f"ok - {shell}: {what}")
            passed += 1
        else:
            print(f"not ok - {shell}: {what}\n{text[-800:]!r}")
            failed += 1
print(f"completion: {passed} passed, {failed} failed, {skipped} skipped")
sys.exit(failed > 0)
