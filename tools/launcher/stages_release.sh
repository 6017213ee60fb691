# shellcheck shell=bash disable=SC2154,SC2034
# The stages of `./towbench test --all`, and those on request. Sourced by test.sh.

stage_attack() {
  built release towbench-bench towbench-panel towbench-study
  local status=0 log=$build/attack.log
  python3 "$root/tests/attack/attack.py" "$root" "$build/release/bin" 2>&1 | tee "$log" || status=${PIPESTATUS[0]}
  local handled missed
  read -r handled missed < <(sed -nE 's/^\| \*\*all\*\* \| [0-9]+ \| ([0-9]+) \| ([0-9]+) \|$/\1 \2/p' "$log")
  passed=$((passed + ${handled:-0})) failed=$((failed + ${missed:-1}))
  return "$status"
}

stage_long_tests() {
  built release
  run_tests release . -R "$(long_tests)"
}

# Units hide a missing include; here every source stands for itself. Checked, not optimised.
stage_alone() {
  built alone all benchmarks diagnose_campaign diagnose_makers
  passed=$((passed + 1))
}

stage_tidy() { count "$root/tools/clang_tidy.sh" "$root" --everything; }

stage_step_cost() {
  built release bbmc_step_cost
  reported "$build/step_cost.log" "$root/tools/control_step_cost.sh" "$build/release"
}

stage_armhf() {
  built release towbench-bench bbmc_record bbmc_controller_process
  reported "$build/armhf.log" "$root/tools/armhf_duty.sh" "$build/release" "$root"
}

stage_package() { reported "$build/package.log" "$root/tools/package_in_bare_debian.sh" "$root"; }

stage_campaign() {
  built release towbench-bench
  count "$bench_program" campaign standard --fresh --out "$build/campaign"
  count "$bench_program" campaign log-full --fresh --out "$build/campaign-log-full"
}

# Of controllers that the bench did not write.
stage_other_controllers() {
  built release towbench-bench c_pid
  count python3 "$root/tests/clients/campaign_of_controllers.py" whole "$root" "$bench_program" "$build/release/tests/clients/c_pid"
}

stage_linuxcnc() {
  built release towbench-bench
  # LinuxCNC serves this stage alone; without it the bench is whole.
  if ! (install_packages "${linuxcnc_packages[@]}"); then
    skip_reason="no ${linuxcnc_packages[*]} to be had here (see above)"
    return 99
  fi
  local status=0 log=$build/linuxcnc.log
  "$root/clients/linuxcnc/build.sh" "$build/linuxcnc" || return 1
  python3 "$root/tests/linuxcnc/measure.py" "$root" "$bench_program" "$build/linuxcnc/towbench.so" "$build/linuxcnc.md" \
    2>&1 | tee "$log" || status=${PIPESTATUS[0]}
  passed=$((passed + $(grep -c '^ok ' "$log"))) failed=$((failed + $(grep -c '^WRONG ' "$log")))
  note=$(sed -n 's/^@@ \(real time unproven\).*/; \1/p' "$log" | head -n 1)
  return "$status"
}

# Every effect under two seeds, hidden by another generator: named, and nothing else, in 19 of 20.
stage_diagnosis() {
  built release diagnose_campaign diagnose_makers
  local log=$build/diagnosis_campaign.log right all
  "$build/release/tests/study/diagnose/diagnose_campaign" 2 2>&1 | tee "$log"
  read -r right all < <(sed -nE 's/^right and alone: ([0-9]+) of ([0-9]+)$/\1 \2/p' "$log")
  count test "$((right * 20))" -ge "$((all * 19))"
}

# A mutant replaces one object of a library, so every source must be an object of its own.
stage_mutants() {
  built mutants mutants towbench-bench
  count "$root/tests/mutants/score.sh" "$build/mutants" "$root"
}

# The guard is guarded: ten slips, each of which must turn it red.
stage_guard_mutations() { count "$root/tests/mutants/guard_mutations.sh" "$root"; }

stage_slurm() {
  # Slurm serves this stage alone; without it the bench is whole.
  ((EUID == 0)) && { apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends slurm-wlm munge; } \
    >"$build/slurm-install.log" 2>&1 </dev/null
  built release towbench-bench
  local status=0
  "$root/tests/slurm/slurm_test.sh" "$bench_program" "$root" || status=$?
  if ((status == 99)); then
    skip_reason='there is no Slurm to be had here (see above)'
  elif ((status == 0)); then
    passed=$((passed + 1))
  fi
  return "$status"
}

stage_build_times() { count "$root/tools/build_times.sh" "$root"; }

stage_carrier_table() {
  local here=$root/tests/carriers kernel=$build/carriers/kernel tree=$build/release log=$build/carrier_table.log
  built release towbench-bench benchmark_protocol_carriers
  {
    "$here/jobs.sh" "$root" "$tree" table-host
    "$here/fetch_kernel.sh" "$kernel" &&
      "$here/boot.sh" "$kernel" 900 "$(printf '%q ' "$here/jobs.sh" "$root" "$tree" table-machine)"
  } >"$log" 2>&1
  echo '| carrier | encoder data | trapezoid-400 | on the wire, to plant + to controller | worst case, digest at 1 kHz | turn: bare, ours, ratio | tracking error, peak | rms, steady |'
  echo '| --- | --- | --- | ---: | ---: | ---: | ---: | ---: |'
  sed -n 's/^@@ row //p' "$log"
  [[ $(grep -c '^@@ row' "$log") == 6 ]] || { tail -n 20 "$log"; failed=$((failed + 1)); return 1; }
  passed=$((passed + 1))
}

# The ratios are printed, not judged: they are this host's, at this hour.
stage_panel_cost() {
  local here=$root/tests/browser work=$build/panel_cost browser
  built release towbench-bench towbench-panel
  browser=$(sh "$here/find_browser.sh") || { failed=$((failed + 1)); return 1; }
  sh "$here/install.sh" "$work/packages"
  count env CHROMIUM="$browser" node "$work/packages/measure_panel.mjs" \
    "$build/release/bin/towbench-bench" "$root" "$work/runs" "${TOWBENCH_BLOCKS:-25}"
}
