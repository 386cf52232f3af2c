#!/bin/sh
# SPDX-License-Identifier: MIT
# A template for a renderer with a command line: template.json names this file. As it stands the renderer is
# diptych itself ($DIPTYCH says where it is), so that it can be tried before anything is changed:
#     diptych compare --renderer mine=compare/external/adapters/template.json
# $1 is the job's file and $2 its text (job.schema.json describes it). Whatever goes to stderr stands in the
# report; an exit code that is not 0 says that there is no picture.
set -eu
job=$1

# A member of the job: field camera eye 0 is job.camera.eye[0]. Nothing where it is null.
field() {
    python3 -c '
import json, sys
at = json.load(open(sys.argv[1]))
for key in sys.argv[2:]: at = at[int(key) if isinstance(at, list) else key]
sys.stdout.write("" if at is None else json.dumps(at) if isinstance(at, dict) else str(at))' "$job" "$@"
}

scene=$(field scene file; echo x)      # the x keeps line ends at the end of a name
picture=$(field output file; echo x)
camera="eye=$(field camera eye 0),$(field camera eye 1),$(field camera eye 2)"
camera="$camera target=$(field camera target 0),$(field camera target 1),$(field camera target 2)"
camera="$camera fov=$(field camera fov_degrees) near=$(field camera near)"
far=$(field camera far)
[ -z "$far" ] || camera="$camera far=$far"
field settings > "$job.settings"
set -- --settings "$job.settings" --path forward_plus --scene-lights off --lights "$job" --camera "$camera"
if [ -n "$(field environment)" ]; then
    set -- "$@" --env "$(field environment file)" --env-sun off
    set -- "$@" --env-rotation "$(field environment rotation_degrees)" --ibl-intensity "$(field environment intensity)"
else
    set -- "$@" --env none
fi
exec "${DIPTYCH:-diptych}" render "${scene%x}" "$@" --channels lit --runs 0 -q -o "${picture%x}"
