#!/bin/sh
# SPDX-License-Identifier: MIT
# Template for a renderer with a command line, used by template.json. It runs diptych itself ($DIPTYCH: path
# of the program), so that you can try it unchanged:
#     diptych compare --renderer mine=compare/external/adapters/template.json
# $1 is the job's file, $2 its text (format: job.schema.json). The report shows stderr. A nonzero exit code
# means that there is no image.
set -eu
job=$1

# Prints a member of the job: "field camera eye 0" is job.camera.eye[0]. Prints nothing for null.
field() {
    python3 -c '
import json, sys
at = json.load(open(sys.argv[1]))
for key in sys.argv[2:]: at = at[int(key) if isinstance(at, list) else key]
sys.stdout.write("" if at is None else json.dumps(at) if isinstance(at, dict) else str(at))' "$job" "$@"
}

scene=$(field scene file; echo x)      # the x preserves trailing newlines of a name
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
