"""A script for Slurm's arrays, for clusters that have no scheduler of Dask."""
import json
import os
import shlex
import sys


def write(jobs, folder, program, settings):
    """DIR/jobs.jsonl, all names expanded, and DIR/slurm.sh, an array of tasks. Returns the script's path.

    settings: {"slurm": number of tasks, "timeout", "memory", "threads", "store", "retries"}.
    """
    os.makedirs(folder, exist_ok=True)
    tasks = min(settings["slurm"], len(jobs))
    listed = os.path.abspath(os.path.join(folder, "jobs.jsonl"))
    with open(listed, "w", encoding="utf-8") as file:
        file.writelines(json.dumps(job.line()) + "\n" for job in jobs)
    words = [sys.executable, "-m", "weft.batch", listed, "-o", os.path.abspath(folder), "--workers", "1", "--quiet",
             "--threads", str(settings["threads"]), "--store", settings["store"], "--retries", str(settings["retries"])]
    for key in ("timeout", "memory"):
        if settings[key]:
            words += [f"--{key}", f"{settings[key]:g}"]
    path = os.path.join(folder, "slurm.sh")
    log = os.path.abspath(folder).replace("%", "%%") + "/slurm-%a.log"
    package = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"""#!/bin/bash
#SBATCH --job-name=weft
#SBATCH --array=0-{tasks - 1}
#SBATCH --cpus-per-task={settings["threads"]}
#SBATCH --output={shlex.quote(log)}
# sbatch {shlex.quote(path)}; when all tasks are done, the command without --part gathers their rows and does what is left:
#   {shlex.join(words)}
export PYTHONPATH={shlex.quote(package)}${{PYTHONPATH:+:$PYTHONPATH}}
export WEFT_PROGRAM={shlex.quote(os.path.abspath(program))}
exec {shlex.join(words)} --part "$SLURM_ARRAY_TASK_ID/{tasks}"
""")
    os.chmod(path, 0o755)
    return path
