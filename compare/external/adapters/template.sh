#!/bin/sh
# SPDX-License-Identifier: MIT
# Template for a renderer with a command line, used by template.json. It runs diptych itself ($DIPTYCH: path
# of the program), so that you can try it unchanged:
#     diptych compare --renderer mine=compare/external/adapters/template.json
# $1 is the job's file, $2 its text (format: job.schema.json). The report shows stderr. A nonzero exit code
# means that there is no image.
set -eu

# Prints the arguments for the job, each quoted for the shell.
arguments=$(python3 -c '
import json, shlex, sys
job = json.load(open(sys.argv[1]))
settings = sys.argv[1] + ".settings"
json.dump(job["settings"], open(settings, "w"))
camera, sky = job["camera"], job["environment"]
view = ["{}={},{},{}".format(key, *camera[key]) for key in ("eye", "target")]
view += ["fov={}".format(camera["fov_degrees"]), "near={}".format(camera["near"])]
if camera["far"] is not None:
    view.append("far={}".format(camera["far"]))
said = [job["scene"]["file"], "--settings", settings, "--camera", " ".join(view), "--lights", sys.argv[1]]
if sky:
    said += ["--env", sky["file"], "--env-rotation", sky["rotation_degrees"], "--ibl-intensity", sky["intensity"]]
else:
    said += ["--env", "none"]
print(*(shlex.quote(str(each)) for each in [*said, "-o", job["output"]["file"]]))' "$1")
eval "set -- $arguments"
exec "${DIPTYCH:-diptych}" render "$@" --path forward_plus --scene-lights off --env-sun off --channels lit --runs 0 -q
