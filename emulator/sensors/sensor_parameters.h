// Parameters of the sensors of one axis. SI; positions are carriage positions in the tank frame,
// 0 at encoder count 0. Values and sources: docs/reference/constants.md, thesis App. A (encoder
// data sheet).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/parameter.h"

namespace towbench::emulator {

enum class EncoderSide { kMotor, kLoad };

[[nodiscard]] constexpr std::array<std::string_view, 2> names_of(EncoderSide /*type*/) noexcept {
  return {"motor", "load"};
}

// Magnetic encoder on the motor shaft, 1000 lines, line driver (App. A, 228456).
// Turning towards max, channel A leads channel B. `counts_per_turn` is a key of the axis itself
// (encoder_counts_per_rev), all else of its table [encoder]. On the load side it sees the load
// behind the elastic transmission; its counts are then those for the way of a motor turn. An
// absolute one has the same lines and tells its count besides, as EnDat 2.1 and BiSS do.
struct EncoderParameters {
  EncoderSide side = EncoderSide::kMotor;
  bool absolute = false;
  std::int64_t counts_per_turn = 4000;  // 4 x the lines: A and B, both edges (6.1.2, 7.2.1)
  double phase_deg = 90.0;              // electrical, from A to B; data sheet: 90 +- 45
  double pulse_width_deg = 180.0;       // electrical, high part of A and of B
  double eccentricity_counts = 0.0;     // amplitude of the once-a-turn error of the grating
  double eccentricity_phase_deg = 0.0;  // mechanical, where that error crosses zero upwards
  std::int64_t index_count = 0;   // the index pulse is high while count mod turn = this; -1: none
  double max_channel_Hz = 200e3;  // data sheet; faster is flagged, not dropped

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("side", side, core::any_finite(), "what it sits on: the motor's shaft or the load");
    v.value("absolute", absolute, core::any_finite(),
            "whether it tells its count in full, besides A and B");
    v.value("phase_deg", phase_deg, core::between(20.0, 160.0),
            "electrical angle from A to B; the data sheet allows 45 to 135");
    v.value("pulse_width_deg", pulse_width_deg, core::between(150.0, 210.0),
            "electrical angle for which a channel is high");
    v.value("eccentricity_counts", eccentricity_counts, core::between(0.0, 50.0),
            "amplitude of the once-a-turn position error");
    v.value("eccentricity_phase_deg", eccentricity_phase_deg, core::between(-360.0, 360.0),
            "motor angle at which the once-a-turn error crosses zero upwards");
    v.value("index_count", index_count, core::between(-1, 1 << 22),
            "count inside a turn at which the index pulse is high; -1: there is none");
    v.value("max_channel_Hz", max_channel_Hz, core::above(0.0),
            "highest rate a channel carries; faster motion is flagged");
  }
};

// Hall switch at one end, seen by a magnet on the carriage. It operates at `position_m` and beyond
// (towards its end). A switching sensor releases `hysteresis_m` back towards the middle, a latching
// one (OR-EMCP-3c) only where the opposite pole passes it, `latch_release_m` back.
struct HallParameters {
  bool fitted = true;
  double position_m = 0.0;
  double hysteresis_m = 0.5e-3;  // assumed
  bool latching = false;
  double latch_release_m = 20e-3;  // assumed
  double delay_s = 0.1e-3;         // assumed; OR-EMCP-3b: below 1 ms

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("fitted", fitted, core::any_finite(), "whether the sensor exists");
    v.value("position_m", position_m, core::between(-1e4, 1e4),
            "carriage position at which the sensor operates");
    v.value("hysteresis_m", hysteresis_m, core::above(0.0),
            "way back towards the middle until a switching sensor releases");
    v.value("latching", latching, core::any_finite(),
            "releases only where the opposite pole passes");
    v.value("latch_release_m", latch_release_m, core::above(0.0),
            "way back towards the middle until a latching sensor releases");
    v.value("delay_s", delay_s, core::between(0.0, 1e-3), "from the field to the line");
  }
};

// Switch that tells a place of the way: active while the load is within half the width of it. Not
// fitted unless a rig has its table. A rig says where and how wide.
struct HomeParameters {
  static constexpr std::array<std::string_view, 2> kRequired{"position_m", "width_m"};
  bool fitted = false;  // no key: its table says so
  double position_m = 0.0;
  double width_m = 2e-3;
  double hysteresis_m = 0.1e-3;  // assumed
  double delay_s = 0.1e-3;       // assumed, as of a hall sensor

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("position_m", position_m, core::between(-1e4, 1e4), "middle of where it is active");
    v.value("width_m", width_m, core::above(0.0), "way over which it is active");
    v.value("hysteresis_m", hysteresis_m, core::above(0.0),
            "way out of that at either edge until it releases");
    v.value("delay_s", delay_s, core::between(0.0, 1e-3), "from the field to the line");
  }
};

// The amplifier's "Monitor I" output (App. A), as digitised. Not fitted unless a rig says so: an
// estimator sees only the sensors that its rig lists.
struct CurrentMonitorParameters {
  bool fitted = false;
  double bandwidth_Hz = 1000.0;    // assumed; below the current loop's 2.5 kHz
  double noise_rms_A = 5e-3;       // assumed
  double bias_deviation_A = 5e-3;  // assumed; the bias itself is drawn from the seed
  double sample_period_s = 1e-3;   // assumed

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("fitted", fitted, core::any_finite(), "whether the current is measured");
    v.value("bandwidth_Hz", bandwidth_Hz, core::between(1.0, 1e5), "first order");
    v.value("noise_rms_A", noise_rms_A, core::at_least(0.0), "white, on each sample");
    v.value("bias_deviation_A", bias_deviation_A, core::at_least(0.0),
            "standard deviation of the constant error");
    v.value("sample_period_s", sample_period_s, core::between(1e-4, 1.0),
            "whole number of plant ticks");
  }
};

// Six-axis force/torque sensor between mount and shaft, tared at the start of the run.
struct ForceSensorParameters {
  bool fitted = false;
  double load_mass_kg = 0.4;          // assumed; shaft and object below it, part of the axes' mass
  double lever_m = 0.30;              // assumed; from the sensor down to where the load is pushed
  double bandwidth_Hz = 200.0;        // assumed
  double force_noise_rms_N = 0.02;    // assumed
  double torque_noise_rms_Nm = 1e-3;  // assumed
  double force_bias_deviation_N = 0.02;    // assumed; the biases are drawn from the seed
  double torque_bias_deviation_Nm = 1e-3;  // assumed
  double sample_period_s = 1e-3;           // assumed

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("fitted", fitted, core::any_finite(), "whether the sensor is mounted");
    v.value("load_mass_kg", load_mass_kg, core::at_least(0.0), "what hangs below the sensor");
    v.value("lever_m", lever_m, core::at_least(0.0),
            "from the sensor down to where the load is pushed and has its centre");
    v.value("bandwidth_Hz", bandwidth_Hz, core::between(1.0, 1e5), "first order");
    v.value("force_noise_rms_N", force_noise_rms_N, core::at_least(0.0), "white, on each sample");
    v.value("torque_noise_rms_Nm", torque_noise_rms_Nm, core::at_least(0.0),
            "white, on each sample");
    v.value("force_bias_deviation_N", force_bias_deviation_N, core::at_least(0.0),
            "standard deviation of each force's constant error");
    v.value("torque_bias_deviation_Nm", torque_bias_deviation_Nm, core::at_least(0.0),
            "standard deviation of each torque's constant error");
    v.value("sample_period_s", sample_period_s, core::between(1e-4, 1.0),
            "whole number of plant ticks");
  }
};

// Camera above the tank (camera.h). All assumed: a USB camera at 25 Hz whose pixel covers half a
// millimetre, and what transport and image processing take.
struct CameraParameters {
  bool fitted = false;
  double frame_period_s = 0.04;
  double delay_s = 0.08;
  double noise_m = 2e-4;
  double resolution_m = 5e-4;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("fitted", fitted, core::any_finite(), "whether the carriage is watched");
    v.value("frame_period_s", frame_period_s, core::between(1e-3, 10.0),
            "whole number of plant ticks");
    v.value("delay_s", delay_s, core::between(0.0, 0.5), "from exposure to arrival");
    v.value("noise_m", noise_m, core::between(0.0, 0.1), "standard deviation, each frame");
    v.value("resolution_m", resolution_m, core::between(1e-6, 0.1), "step of what is seen");
  }
};

}  // namespace towbench::emulator
