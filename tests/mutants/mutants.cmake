# One mutant, one reaction that is missing or wrong.

# ---- what stays latched
mutant(no_latch system/motion_safety.cc
  "void MotionControl::settle_after_fault() noexcept {\n"
  "void MotionControl::settle_after_fault() noexcept {\n  if (status_.fault != ErrorCode::kNone && !any_powered()) { clear_fault(); }\n")
mutant(end_stop_releases_itself system/motion_safety.cc
  "  if (stops && any_powered()) {"
  "  if (!edge.active && status_.fault != ErrorCode::kNone) { clear_fault(); }\n  if (stops && any_powered()) {")
mutant(kill_releases_itself system/motion_safety.cc
  "      cut_all(ErrorCode::kFaultKillSwitch, Axis::kY);\n    }\n    return;"
  "      cut_all(ErrorCode::kFaultKillSwitch, Axis::kY);\n    } else { clear_fault(); }\n    return;")

# ---- how it stops
mutant(coasting_stop system/brake.cc
  "BrakeState::kBraking || coasting_" "BrakeState::kBraking || true")
mutant(weak_brake system/brake.cc
  "limit_Nm_(braking_torque_Nm(axis))" "limit_Nm_(0.25 * braking_torque_Nm(axis))")
mutant(kill_brakes_instead system/motion_safety.cc
  "cut_all(ErrorCode::kFaultKillSwitch, Axis::kY)" "brake_all(ErrorCode::kFaultKillSwitch, Axis::kY)")
mutant(only_the_other_axis_brakes system/motion_safety.cc
  "    if (is_driven(axis.mode())) {\n      // A frozen"
  "    if (each != which && is_driven(axis.mode())) {\n      // A frozen")
mutant(no_blind_brake system/motion_safety.cc
  "  if (axes_[which].begin_blind_braking(now_ns_, suspect)) {" "  if (false) {")
mutant(blind_brake_pushes_on system/brake.cc
  "-blind_direction_ * limit_Nm_" "blind_direction_ * limit_Nm_")
mutant(late_speed_taken_for_prompt system/brake.cc
  "late_ = max_age_ns_ > kPrompt_ns;" "late_ = false;")

# ---- who is heard
mutant(hall_ends_swapped system/motion_safety.cc
  "? End::kMin : End::kMax}" "? End::kMax : End::kMin}")
mutant(hall_axes_swapped system/motion_safety.cc
  "? Axis::kY : Axis::kX,\n          line" "? Axis::kX : Axis::kY,\n          line")
mutant(limits_not_armed_in_open_loop system/motion_safety.cc
  "if (stops && any_powered()) {" "if (stops && any_powered() && status_.motion != MotionKind::kOpenLoop) {"
  "if (axis.end_stops().moves_into(" "if (status_.motion != MotionKind::kOpenLoop && axis.end_stops().moves_into(")
mutant(limits_not_armed_in_references system/motion_safety.cc
  "if (stops && any_powered()) {" "if (stops && any_powered() && status_.motion != MotionKind::kReference) {"
  "if (axis.end_stops().moves_into(" "if (status_.motion != MotionKind::kReference && axis.end_stops().moves_into(")
mutant(kill_ignored_in_open_loop system/motion_safety.cc
  "    if (edge.active) {\n      cut_all" "    if (edge.active && status_.motion != MotionKind::kOpenLoop) {\n      cut_all"
  "  if (status_.kill_switch_pressed && (" "  if (status_.kill_switch_pressed && status_.motion != MotionKind::kOpenLoop && (")

mutant(no_debounce system/end_stop_guard.cc
  "return active && !bounces;" "static_cast<void>(bounces);\n  return active;")

# ---- what is not believed
mutant(no_plausibility system/encoder_plausibility.cc
  "if (settings_.enabled && scope" "if (false && scope")
mutant(no_kinematic_check system/encoder_plausibility.cc
  "  const double expected = last_rate" "  if (true) { return ErrorCode::kNone; }\n  const double expected = last_rate")
mutant(no_stuck_check system/encoder_plausibility.cc
  "  if (push_.direction != direction) {" "  if (true) {"
  "if (is_held_by_nothing()) {" "if (false) {")
mutant(no_held_check system/encoder_plausibility.cc
  "if (is_held_by_nothing()) {" "if (false) {")
mutant(no_index_check system/encoder_plausibility.cc
  "settings_.index_fitted && !index_good ?" "settings_.index_fitted && !index_good && false ?")
mutant(no_illegal_transition_check system/encoder_plausibility.cc
  "if (illegal_.sum() >" "if (false && illegal_.sum() >")
mutant(amplifier_ready_ignored system/axis_control.cc
  "return safety_.amplifier_ready_fitted &&" "return false && safety_.amplifier_ready_fitted &&")

# ---- a hard end ahead
mutant(no_pressing_at_the_end system/end_ahead.cc
  "return goes_on && runs_on > left_count ?" "return false && goes_on && runs_on > left_count ?")
mutant(no_turning_back system/end_ahead.cc
  "turns_back_ = goes_on &&" "turns_back_ = false && goes_on &&")

# ---- link and host
mutant(lost_message_ignored host/controller_node.cc
  "    if (!continues) {" "    if (false && !continues) {")
mutant(lost_peer_ignored host/controller_node.cc
  "implementation_->lose_link(core::ErrorCode::kFaultLinkLost);" "")
mutant(overrun_ignored system/motion_safety.cc
  "brake_all(ErrorCode::kFaultControlOverrun, Axis::kY);" "")
mutant(clock_step_ignored system/motion_safety.cc
  "if (time_ns < before_ns) {" "if (false && time_ns < before_ns) {")

# ---- what must stay bounded
mutant(integral_wind_up system/pid.cc
  "if (winds_up) {" "if (false && winds_up) {")
mutant(unbounded_log system/data_log.cc
  "if (full()) {" "if (false && full()) {")
