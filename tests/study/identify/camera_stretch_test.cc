// The transmission's elastic error of the emulated machine, told by encoder and camera alone,
// against the emulator's truth.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "emulator/sensors/camera.h"
#include "harness/fault_cases/case_run.h"
#include "harness/fixtures/controller_fixture.h"
#include "harness/fixtures/rig_fixture.h"
#include "study/identify/elastic_error.h"

namespace towbench::study::identify {
namespace {

using core::Axis;

struct Watched {
  ElasticInput input;
  double true_rms_m = 0;  // of motor less carriage at the frames' exposures, mean taken off
  double true_peak_m = 0;
};

// The thesis's circle on both axes, watched by a camera.
Watched watched_circle(Axis axis, const emulator::CameraParameters& parameters) {
  harness::SourceFiles sources;
  harness::ExperimentFixture fixture;
  fixture.rig = harness::load_rig("fixtures/rigs/macs-nominal.toml", sources);
  fixture.controller = harness::load_controller("fixtures/controllers/bbmc-tuned.toml", sources);
  fixture.experiment.name = "watched circle";
  fixture.experiment.duration_limit_s = 40;
  fixture.experiment.console = {{.send = "reset poscalib y 0.449092m", .expect = "ok"},
                                {.send = "reset poscalib x 0.336819m", .expect = "ok"},
                                {.send = "run -circle --radius 0.2m --period 7s --turns 2",
                                 .expect = "done",
                                 .wait_idle = true,
                                 .timeout_s = 30}};
  const auto record = harness::run_case(fixture, fixture.rig.parameters, {}, {.seed = 1});
  Watched watched;
  emulator::Camera camera(parameters, 1);
  for (const auto& row : record->truth) {
    if (const auto frame = camera.see(
            row.time_ns, {{row.axes[Axis::kY].carriage_m, row.axes[Axis::kX].carriage_m}})) {
      watched.input.frame_s.push_back(core::seconds(frame->arrived_ns));
      watched.input.seen_m.push_back(frame->carriage_m[axis]);
    }
  }
  double n = 0;
  double sum = 0;
  double square = 0;
  for (const auto& row : record->log) {
    const auto& state = row.axes[axis];
    watched.input.time_s.push_back(core::seconds(row.time_ns));
    watched.input.motor_m.push_back(state.position_m);
    watched.input.speed_m_per_s.push_back(state.reference_velocity_m_per_s);
    if (state.reference_velocity_m_per_s != 0) {
      const double stretch = state.position_m - record->truth_at(row.time_ns).axes[axis].carriage_m;
      n += 1;
      sum += stretch;
      square += stretch * stretch;
      watched.true_peak_m = std::max(watched.true_peak_m, std::fabs(stretch));
    }
  }
  watched.true_rms_m = std::sqrt(square / n - sum * sum / (n * n));
  return watched;
}

// X's stretch is a fifth of a pixel of the camera that suffices on Y, so it has a finer one.
TEST(CameraStretch, TellsTheElasticErrorThatTheTruthHas) {
  const emulator::CameraParameters usual{.fitted = true};
  const emulator::CameraParameters fine{.fitted = true, .noise_m = 5e-5, .resolution_m = 1e-4};
  for (const Axis axis : core::kPlanarAxes) {
    const auto& camera = axis == Axis::kX ? fine : usual;
    const auto watched = watched_circle(axis, camera);
    const auto found = elastic_error(watched.input);
    ASSERT_EQ(found.trouble, "") << core::name_of(axis);
    EXPECT_GT(found.frames, 300U);
    EXPECT_NEAR(found.delay_s.value, 0.08, 2e-3) << core::name_of(axis);
    // What swings on the transmission is in the truth and not in the model.
    const double ratio = found.rms_m / watched.true_rms_m;
    EXPECT_GT(ratio, 0.65) << core::name_of(axis);
    EXPECT_LT(ratio, 1.2) << core::name_of(axis);
    RecordProperty(std::string(core::name_of(axis)) + "_over_truth", std::to_string(ratio));
    EXPECT_LT(found.peak_m, 1.5 * watched.true_peak_m);
    // It cannot see better than its pixels.
    EXPECT_GT(found.residual_rms_m, camera.resolution_m / std::sqrt(12));
    EXPECT_LT(found.residual_rms_m, 5e-4);
  }
}

// A camera of coarse pixels has the same stretch with a wider interval, not another one.
TEST(CameraStretch, HasAWiderIntervalWithACoarserCamera) {
  const auto fine = elastic_error(watched_circle(Axis::kY, {.fitted = true}).input);
  const auto coarse = elastic_error(
      watched_circle(Axis::kY, {.fitted = true, .noise_m = 1e-3, .resolution_m = 2e-3}).input);
  EXPECT_GT(coarse.friction_stretch_m.half_width, 2 * fine.friction_stretch_m.half_width);
  EXPECT_LT(std::fabs(coarse.friction_stretch_m.value - fine.friction_stretch_m.value),
            2 * coarse.friction_stretch_m.half_width);
}

}  // namespace
}  // namespace towbench::study::identify
