// What BBMC believes of one axis: drive train, encoder, drive, ends, law. SI at the motor shaft
// unless a name says otherwise. The defaults are the nominal Y axis of docs/reference/constants.md;
// X is x_axis_defaults().
//
// These are the controller's own beliefs. They are not read from the plant, and may be wrong.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "bbmc/system/observer_configuration.h"
#include "core/parameter.h"

namespace towbench::bbmc {

// Thesis 3.4.2.
enum class VelocityMethod : std::uint8_t { kFrequency = 0, kPeriod = 1, kHybrid = 2 };

[[nodiscard]] constexpr std::array<std::string_view, 3> names_of(VelocityMethod /*type*/) noexcept {
  return {"frequency", "period", "hybrid"};
}

// Of the law (4.12), motor angle to motor torque.
struct PidGains {
  double proportional_Nm_per_rad = 0.12;
  double integral_Nm_per_rad_s = 0.6;
  double derivative_Nm_s_per_rad = 2.4e-3;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("proportional_Nm_per_rad", proportional_Nm_per_rad, core::at_least(0.0),
            "K_P of (4.12)");
    v.value("integral_Nm_per_rad_s", integral_Nm_per_rad_s, core::at_least(0.0), "K_I of (4.12)");
    v.value("derivative_Nm_s_per_rad", derivative_Nm_s_per_rad, core::at_least(0.0),
            "K_D of (4.12)");
  }
  friend bool operator==(const PidGains&, const PidGains&) = default;
};

// The identified model (3.33) run forwards: J q'' + B q' + C sgn(q').
struct FeedForward {
  bool enabled = false;
  double inertia_kg_m2 = 1.714e-5;                  // J, Table 7.4
  double viscous_friction_Nm_s_per_rad = 1.106e-5;  // B, Table 7.4
  double coulomb_friction_Nm = 2.26e-3;             // C, Table 7.4

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("enabled", enabled, core::any_finite(), "whether the law adds the model's torque");
    v.value("inertia_kg_m2", inertia_kg_m2, core::at_least(0.0), "identified J");
    v.value("viscous_friction_Nm_s_per_rad", viscous_friction_Nm_s_per_rad, core::at_least(0.0),
            "identified B");
    v.value("coulomb_friction_Nm", coulomb_friction_Nm, core::at_least(0.0), "identified C");
  }
};

// Friction along the reference, with its rise towards standstill by the Lorentz form (3.26). When
// it is on, it takes the place of the feed-forward's B and C.
struct FrictionCompensation {
  bool enabled = false;
  double breakaway_Nm = 3.7e-3;                     // S, (7.2)
  double coulomb_friction_Nm = 2.26e-3;             // C, Table 7.4
  double viscous_friction_Nm_s_per_rad = 1.106e-5;  // B, Table 7.4
  double stribeck_speed_rad_per_s = 6.0;            // assumed
  double smoothing_rad_per_s = 0.3;  // half of it at this speed: no step where the speed is 0

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("enabled", enabled, core::any_finite(), "whether the law adds the friction's torque");
    v.value("breakaway_Nm", breakaway_Nm, core::at_least(0.0), "S, just above standstill");
    v.value("coulomb_friction_Nm", coulomb_friction_Nm, core::at_least(0.0), "C, at speed");
    v.value("viscous_friction_Nm_s_per_rad", viscous_friction_Nm_s_per_rad, core::at_least(0.0),
            "B");
    v.value("stribeck_speed_rad_per_s", stribeck_speed_rad_per_s, core::above(0.0),
            "speed over which S falls to C");
    v.value("smoothing_rad_per_s", smoothing_rad_per_s, core::above(0.0),
            "reference speed at which half of the dry friction is given");
  }
};

// Moves the motor's reference by the stretch of the chain, so that the carriage and not the motor
// is where it should be: for references whose acceleration does not jump.
struct ChainFeedForward {
  bool enabled = false;
  double carriage_friction_Nm = 1.47e-3;  // 0.65 C, share *assumed*
  double smoothing_rad_per_s = 3.0;       // half of the friction's stretch at this speed

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("enabled", enabled, core::any_finite(),
            "whether the reference leads by the chain's stretch");
    v.value("carriage_friction_Nm", carriage_friction_Nm, core::at_least(0.0),
            "the carriage's share of the friction, at the motor");
    v.value("smoothing_rad_per_s", smoothing_rad_per_s, core::above(0.0),
            "reference speed at which half of the friction's stretch is given");
  }
};

// Position calibration against the hall switches (homing.h).
struct HomingConfiguration {
  double seek_speed_ratio = 0.6;
  double approach_speed_m_per_s = 1e-3;
  double acceleration_m_per_s2 = 2.0;
  double back_off_m = 3e-3;
  double longest_release_m = 0.06;
  double carriage_friction_Nm = 2.4e-3;  // 0.65 x (7.2), share *assumed*

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("seek_speed_ratio", seek_speed_ratio, core::between(0.01, 0.8),
            "speed of the search over what the nearer end can stop");
    v.value("approach_speed_m_per_s", approach_speed_m_per_s, core::between(1e-5, 0.05),
            "speed of the approach that counts");
    v.value("acceleration_m_per_s2", acceleration_m_per_s2, core::between(0.01, 10.0),
            "of starts and stops");
    v.value("back_off_m", back_off_m, core::between(1e-4, 0.1), "way beyond the switch's release");
    v.value("longest_release_m", longest_release_m, core::between(1e-3, 0.5),
            "a switch that has not released after this way back is stuck");
    v.value("carriage_friction_Nm", carriage_friction_Nm, core::at_least(0.0),
            "what stretches the chain at the approach speed, at the motor");
  }
};

struct VelocityEstimation {
  VelocityMethod method = VelocityMethod::kHybrid;
  double capture_clock_Hz = 1.5625e6;  // 100 MHz / 64, the firmware's eQEP capture unit
  double switch_ratio = 1.0;           // 1 = where the two quantisation errors are equal
  double hysteresis_ratio = 0.04;      // half width of the band around the switching speed
  double timeout_s = 0.04;             // longest wait for an edge: a little below 2^16 ticks

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("method", method, core::any_finite(), "estimator, thesis 3.4.2");
    v.value("capture_clock_Hz", capture_clock_Hz, core::between(1e3, 1e8),
            "clock of the edge-to-edge timer");
    v.value("switch_ratio", switch_ratio, core::between(0.01, 100.0),
            "hybrid: switching speed over sqrt(sample rate x capture clock) counts/s");
    v.value("hysteresis_ratio", hysteresis_ratio, core::between(0.0, 0.5),
            "hybrid: half width of the switching band over the switching speed");
    v.value("timeout_s", timeout_s, core::between(1e-4, 60.0),
            "without an edge for so long the speed is 0");
  }
};

struct DriveConfiguration {
  double torque_constant_Nm_per_A = 26.7e-3;  // K_T, Table 7.1
  double amplifier_gain_A_per_V = 0.37;       // K_amp, Table 7.1
  double pwm_amplitude_V = 10.0;              // Table 7.1
  double current_limit_A = 3.7;               // I_max, Table 7.1
  double duty_limit_pct = 100.0;
  std::int64_t pwm_period_ticks = 1000;  // TBPRD of the firmware

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("torque_constant_Nm_per_A", torque_constant_Nm_per_A, core::above(0.0), "K_T");
    v.value("amplifier_gain_A_per_V", amplifier_gain_A_per_V, core::above(0.0), "K_amp");
    v.value("pwm_amplitude_V", pwm_amplitude_V, core::above(0.0),
            "voltage at the amplifier's input at 100 % duty");
    v.value("current_limit_A", current_limit_A, core::above(0.0),
            "largest motor current asked for");
    v.value("duty_limit_pct", duty_limit_pct, core::between(1.0, 100.0), "largest duty written");
    v.value("pwm_period_ticks", pwm_period_ticks, core::between(10, 65535),
            "ticks of a PWM period; one tick is the step of the duty");
  }

  // Motor torque at 100 % duty.
  [[nodiscard]] double full_duty_torque_Nm() const noexcept {
    return pwm_amplitude_V * amplifier_gain_A_per_V * torque_constant_Nm_per_A;
  }
  // The smaller of what current and duty limit allow.
  [[nodiscard]] double torque_limit_Nm() const noexcept {
    const double by_current = current_limit_A * torque_constant_Nm_per_A;
    const double by_duty = full_duty_torque_Nm() * duty_limit_pct / 100.0;
    return by_current < by_duty ? by_current : by_duty;
  }
};

// Where the ends are believed to be, in counts once the position is calibrated.
struct EndsConfiguration {
  std::int64_t hard_min_count = 0;
  std::int64_t hard_max_count = 1'760'000;  // 7.2.1
  std::int64_t hall_min_count = 1'000;      // firmware preset
  std::int64_t hall_max_count = 1'740'000;  // firmware preset
  std::int64_t soft_min_count = 10'000;     // firmware
  std::int64_t soft_max_count = 1'650'000;  // firmware

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("hard_min_count", hard_min_count, core::any_finite(), "mechanical end towards min");
    v.value("hard_max_count", hard_max_count, core::any_finite(), "mechanical end towards max");
    v.value("hall_min_count", hall_min_count, core::any_finite(), "hall switch towards min");
    v.value("hall_max_count", hall_max_count, core::any_finite(), "hall switch towards max");
    v.value("soft_min_count", soft_min_count, core::any_finite(), "no motion is planned below");
    v.value("soft_max_count", soft_max_count, core::any_finite(), "no motion is planned above");
  }
};

// What stopping takes. The elastic chain lets the carriage run on when the motor is already held;
// see stopping_distance.h.
struct BrakingConfiguration {
  double inertia_kg_m2 = 1.714e-5;          // J, Table 7.4: what the drive has to stop
  double rotor_inertia_kg_m2 = 3.6e-6;      // App. A
  double held_motor_chain_Hz = 4.12;        // *assumed* 9 Hz free-free, carriage on a held motor
  double gear_torque_limit_Nm = 3.2;        // App. A, intermittent, at the gear's output
  double speed_gain_Nm_s_per_rad = 2.4e-3;  // of the braking law near standstill
  double standstill_m_per_s = 1.2e-3;       // 500 counts/s, the firmware's threshold
  double standstill_time_s = 0.08;          // below that for so long: power off
  double timeout_s = 1.5;                   // power off whatever the speed

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("inertia_kg_m2", inertia_kg_m2, core::above(0.0), "effective, carriage included");
    v.value("rotor_inertia_kg_m2", rotor_inertia_kg_m2, core::above(0.0),
            "the part that turns with the motor");
    v.value("held_motor_chain_Hz", held_motor_chain_Hz, core::above(0.0),
            "frequency of the carriage on the chain when the motor is held");
    v.value("gear_torque_limit_Nm", gear_torque_limit_Nm, core::above(0.0),
            "at the gear's output; braking stays below it");
    v.value("speed_gain_Nm_s_per_rad", speed_gain_Nm_s_per_rad, core::above(0.0),
            "torque per motor speed of the braking law, before its limit");
    v.value("standstill_m_per_s", standstill_m_per_s, core::above(0.0), "taken as no motion");
    v.value("standstill_time_s", standstill_time_s, core::between(0.0, 10.0),
            "no motion for so long ends a stop");
    v.value("timeout_s", timeout_s, core::between(0.01, 60.0), "longest time a stop may take");
  }
};

// Thresholds of the encoder's plausibility (encoder_plausibility.h).
struct PlausibilityConfiguration {
  bool enabled = true;
  double worst_breakaway_Nm = 5.3e-3;  // S of (7.2) + *assumed* 1.6e-3 in mid tank
  double external_load_N = 0.0;        // largest force from outside that is no fault
  bool index_fitted = true;
  std::int64_t index_tolerance_counts = 3;
  std::int64_t illegal_transitions_max = 3;  // in any 20 ms
  std::int64_t noise_edges_max = 40;         // edges beyond the net count, in any 20 ms

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("enabled", enabled, core::any_finite(), "whether the encoder is judged");
    v.value("worst_breakaway_Nm", worst_breakaway_Nm, core::above(0.0),
            "torque that moves the axis wherever it stands");
    v.value("external_load_N", external_load_N, core::at_least(0.0),
            "force on the carriage that the drive may have to hold");
    v.value("index_fitted", index_fitted, core::any_finite(), "whether the encoder has an index");
    v.value("index_tolerance_counts", index_tolerance_counts, core::between(0, 1000),
            "how far an index pulse may be from its place");
    v.value("illegal_transitions_max", illegal_transitions_max, core::between(0, 100'000),
            "illegal transitions allowed in any 20 ms");
    v.value("noise_edges_max", noise_edges_max, core::between(0, 100'000),
            "edges beyond the net count allowed in any 20 ms");
  }
};

struct AxisConfiguration {
  bool exists = true;
  double gear_ratio = 1539.0 / 44.0;           // n, App. A
  double sprocket_radius_m = 0.050;            // R, firmware
  std::int64_t encoder_counts_per_rev = 4000;  // 6.1.2
  double speed_limit_m_per_s = 0.570;          // top speed at the voltage limit
  PidGains gains;
  FeedForward feed_forward;
  FrictionCompensation friction;
  DisturbanceObserverSettings disturbance_observer;
  NonlinearObserverSettings nonlinear_observer;
  StateObserverSettings state_observer;
  ChainFeedForward chain;
  VelocityEstimation velocity;
  DriveConfiguration drive;
  EndsConfiguration ends;
  BrakingConfiguration braking;
  PlausibilityConfiguration plausibility;
  HomingConfiguration homing;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("exists", exists, core::any_finite(), "whether the machine has this axis");
    v.value("gear_ratio", gear_ratio, core::above(0.0), "motor turns per sprocket turn");
    v.value("sprocket_radius_m", sprocket_radius_m, core::above(0.0), "pitch radius");
    v.value("encoder_counts_per_rev", encoder_counts_per_rev, core::between(4, 40'000),
            "counts a motor turn, 4 x the encoder's lines");
    v.value("speed_limit_m_per_s", speed_limit_m_per_s, core::above(0.0), "refused above");
    v.group("gains", gains, "PID law");
    v.group("feed_forward", feed_forward, "model torque added to the law");
    v.group("friction", friction, "friction compensation added to the law");
    v.group("disturbance_observer", disturbance_observer, "what the model leaves over");
    v.group("nonlinear_observer", nonlinear_observer, "what friction compensation leaves over");
    v.group("state_observer", state_observer, "motor, carriage and load from the encoder");
    v.group("chain", chain, "stretch of the chain added to the reference");
    v.group("velocity", velocity, "velocity estimation");
    v.group("drive", drive, "from torque to PWM");
    v.group("ends", ends, "believed positions of the ends");
    v.group("braking", braking, "safety stop");
    v.group("plausibility", plausibility, "when the encoder is not believed");
    v.group("homing", homing, "position calibration against the hall switches");
  }

  [[nodiscard]] double rad_per_count() const noexcept {  // (3.43)
    return 2.0 * std::numbers::pi / static_cast<double>(encoder_counts_per_rev);
  }
  [[nodiscard]] double metres_per_motor_rad() const noexcept {
    return sprocket_radius_m / gear_ratio;
  }
  [[nodiscard]] double m_per_count() const noexcept {  // (3.44)
    return rad_per_count() * metres_per_motor_rad();
  }
  [[nodiscard]] double counts_per_m() const noexcept { return 1.0 / m_per_count(); }  // (3.42)
  // Middle of the count, so that quantisation has no bias.
  [[nodiscard]] double position_m(std::int64_t count) const noexcept {
    return (static_cast<double>(count) + 0.5) * m_per_count();
  }
};

// The nominal X axis.
[[nodiscard]] AxisConfiguration x_axis_defaults() noexcept;

// The gains of BBMC 0.5 in SI: u in % duty; K_P per count, K_I per count and sample, K_D per
// count/s.
[[nodiscard]] PidGains gains_from_bbmc_units(const AxisConfiguration& axis, double sample_rate_Hz,
                                             double proportional, double integral,
                                             double derivative) noexcept;

}  // namespace towbench::bbmc
