#!/usr/bin/env bash
# docs/measurements/tracking-identified.md: Table 7.6 with BBMC set up from an identification of the machine that it drives.
# usage: write_tracking_identified.sh ROOT STUDY WORK      WORK: folder of the identifications; what is done stays
set -euo pipefail
root=${1:?usage: write_tracking_identified.sh ROOT STUDY WORK}
study=$(realpath "${2:?}")
mkdir -p "${3:?}"
work=$(realpath "$3")
cd "$root"

for machine in 0 1 2; do
  # 1 and 4: an estimate outside its tolerance, an experiment refused. The controller is set up from what there is.
  code=0
  "$study" identify --machine "$machine" --axis y --track --resume --quiet --out "$work/$machine" >/dev/null || code=$?
  case $code in 0 | 1 | 4) ;; *) exit "$code" ;; esac
done
{
  cat <<'PAGE'
# Tracking: set up from an identification, and homed

Written by `tools/write_tracking_identified.sh`. Table 7.6's trapezoids on Y, 0.8 s to speed and 3 s of it, in lockstep. On the left BBMC has the beliefs
of its file, which are those of the nominal machine, and is told its exact place. On the right it is set up from `./towbench identify` of the
machine that it drives and finds the place of both axes by their switches (`poscalib`), then goes to the same start. X is not identified for
this page: it keeps the beliefs of its file on both sides, and is homed all the same.
"Encoder frozen": X has more friction than its file states, and homing takes that for a failed encoder; with X set up too it homes
(`IdentifiedController.HomesMachinesOnWhichItsFileIsOffOrTrips`).

um. Mean and RMS: motor side, steady state. Carriage peak: the reference in BBMC's frame against the truth, whole profile, so that an error of
the place is in it. Place off: BBMC's position of the motor, less the true one. `bbmc-best` runs S-curves and leads the motor by the
chain's stretch on purpose.

PAGE
  cat "$work"/{0,1,2}/tracking.md
} >docs/measurements/tracking-identified.md
