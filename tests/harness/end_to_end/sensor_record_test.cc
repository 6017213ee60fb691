// Force and motor current in the run folder: every sample that the plant sent, at the sensor's own
// rate, whatever lies between plant and controller.
#include <cmath>

#include <gtest/gtest.h>

#include "harness/checks/sensor_files.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

// A short tow on the instrumented machine; X's current is sampled faster than the log's rows.
ExperimentFixture tow(const TemporaryFixtures& files, const char* sensors = "") {
  std::filesystem::copy("fixtures", files.folder(), std::filesystem::copy_options::recursive);
  auto rig = contents_of("fixtures/rigs/tow-cylinder.toml");
  const std::string fitted = "current_monitor = { fitted = true }\n\n[force_sensor]\n";
  rig.replace(rig.find(fitted), fitted.size(),
              "current_monitor = { fitted = true, sample_period_s = 0.0003 }\n\n[force_sensor]\n" +
                  std::string(sensors));
  files.write("rigs/tow.toml", rig);
  return load_experiment(files.write("experiments/tow.toml", R"(schema = 1
name = "tow"
rig = "../rigs/tow.toml"
controller = "../controllers/bbmc-tuned.toml"
duration_limit_s = 20.0

[[console]]
send = "reset poscalib y 0.449092m"
expect = "ok"

[[console]]
send = "reset poscalib x 0.336819m"
expect = "ok"

[[console]]
send = "run -trapez y --distance 0.9m --speed 0.3m/s --acceleration 0.4s --smooth 0.243s"
expect = "done"
wait = "idle"

[[budget]]
metric = "fault_number"
max = 0.0
source = "SAF-1"
)"));
}

// Hears what the controller hears.
class Witness final : public RunTap, public protocol::MessageSink {
 public:
  std::vector<protocol::ForceSample> force;
  core::PerAxis<std::vector<protocol::CurrentSample>> currents;

  using MessageSink::on;
  void on(const protocol::ForceSample& sample) noexcept override { force.push_back(sample); }
  void on(const protocol::CurrentSample& sample) noexcept override {
    currents[sample.axis].push_back(sample);
  }
  [[nodiscard]] protocol::MessageSink* witness() noexcept override { return this; }
  void row(const LogRow& /*row*/,
           const core::PerAxis<bbmc::EdgeTimes>& /*edges*/) noexcept override {}
  void truth(const emulator::TruthRow& /*row*/) noexcept override {}
  void exchange(core::Nanoseconds /*took_ns*/) noexcept override {}
  void event(std::string_view /*line*/) noexcept override {}
  void console(std::string_view /*text*/) noexcept override {}
};

TEST(SensorRecord, HoldsEverySampleThatTheControllerWasSent) {
  const TemporaryFixtures files;
  Witness witness;
  RunOptions options;
  options.out = files.folder() / "runs";
  options.tap = &witness;
  const auto run = run_experiment(tow(files), options);
  ASSERT_EQ(run.exit_code, kExitPass) << complaints_of(run);

  const auto force = CsvTable::load(run.folder / kForceFile);
  ASSERT_EQ(force.rows(), witness.force.size());
  ASSERT_GT(force.rows(), 1000U);
  const auto column = [](const CsvTable& table, const char* name, std::size_t row) {
    return static_cast<float>(table.column(name)[row]);
  };
  for (std::size_t i = 0; i < force.rows(); ++i) {
    const auto& sent = witness.force[i];
    ASSERT_EQ(core::nanoseconds(force.column("time_s")[i]), sent.time_ns);
    ASSERT_EQ(column(force, "force_x_N", i), sent.force_N[0]);
    ASSERT_EQ(column(force, "force_y_N", i), sent.force_N[1]);
    ASSERT_EQ(column(force, "force_z_N", i), sent.force_N[2]);
    ASSERT_EQ(column(force, "torque_x_Nm", i), sent.torque_Nm[0]);
    ASSERT_EQ(column(force, "torque_y_Nm", i), sent.torque_Nm[1]);
    ASSERT_EQ(column(force, "torque_z_Nm", i), sent.torque_Nm[2]);
  }
  for (const auto axis : core::kPlanarAxes) {
    const auto current = CsvTable::load(run.folder / current_file(axis));
    const auto name = std::string(core::name_of(axis)) + "_current_A";
    ASSERT_EQ(current.rows(), witness.currents[axis].size());
    for (std::size_t i = 0; i < current.rows(); ++i) {
      ASSERT_EQ(core::nanoseconds(current.column("time_s")[i]), witness.currents[axis][i].time_ns);
      ASSERT_EQ(column(current, name.c_str(), i), witness.currents[axis][i].armature_current_A);
    }
  }
  const auto x_time_s = CsvTable::load(run.folder / "current_x.csv");
  EXPECT_EQ(core::nanoseconds(x_time_s.column("time_s")[1]), 600'000) << "a rate of its own";
}

TEST(SensorRecord, IsTheSameInOneProcessAndInTwo) {
  const TemporaryFixtures files;
  const auto fixture = tow(files);
  Runs runs;
  const auto one = runs.run(fixture);
  const auto two = runs.run(fixture, Carrier::kLocal);
  EXPECT_EQ(two.exit_code, kExitPass) << complaints_of(two);
  for (const auto& file : sensor_files()) {
    const bool is_fitted = file == kForceFile || file == current_file(core::Axis::kY) ||
                           file == current_file(core::Axis::kX);
    EXPECT_EQ(contents_of(one.folder / file).empty(), !is_fitted) << file;
    EXPECT_TRUE(contents_of(one.folder / file) == contents_of(two.folder / file)) << file;
  }
}

// (3.7): at a steady 0.3 m/s the cylinder of the rig is braked by 8.78 N s2/m2 x (0.3 m/s)^2.
TEST(SensorRecord, ShowsTheDragOfASteadyTow) {
  const TemporaryFixtures files;
  Runs runs;
  const auto run = runs.run(tow(files, "force_noise_rms_N = 0.0\nforce_bias_deviation_N = 0.0\n"));
  ASSERT_EQ(run.exit_code, kExitPass) << complaints_of(run);
  const auto log = CsvTable::load(run.folder / "log.csv");
  const auto force = CsvTable::load(run.folder / kForceFile);
  const auto time_s = force.column("time_s");
  double sum_N = 0;
  std::size_t samples = 0;
  std::size_t row = 0;
  for (std::size_t i = 0; i < force.rows(); ++i) {
    while (row + 1 < log.rows() && log.column("time_s")[row + 1] <= time_s[i]) {
      ++row;
    }
    if (log.column("y_reference_velocity_m_per_s")[row] > 0.2999) {
      sum_N += force.column("force_y_N")[i];
      ++samples;
    }
  }
  ASSERT_GT(samples, 100U);
  EXPECT_NEAR(sum_N / static_cast<double>(samples), -8.78 * 0.3 * 0.3, 0.05);
}

// A frame is of the carriage when it was exposed, to half a pixel and noise.
TEST(SensorRecord, HoldsEachFrameOfTheCameraWithWhenItArrived) {
  Runs runs;
  const auto run = runs.run("circle-watched");
  ASSERT_EQ(run.exit_code, kExitPass) << complaints_of(run);
  const auto camera = CsvTable::load(run.folder / kCameraFile);
  const auto truth = CsvTable::load(run.folder / "truth.csv");
  const auto arrived_s = camera.column("time_s");
  ASSERT_GT(camera.rows(), 300U);
  for (const auto& name : camera.names()) {
    EXPECT_TRUE(name == "time_s" || !truth.has(name)) << name << " would be drawn as the truth";
  }
  std::size_t row = 0;
  double off_m = 0;
  for (std::size_t i = 0; i < camera.rows(); ++i) {
    const double exposed_s = 0.04 * static_cast<double>(i + 1);
    ASSERT_NEAR(arrived_s[i], exposed_s + 0.08, 1e-9);
    while (row + 1 < truth.rows() && truth.column("time_s")[row] < exposed_s - 1e-9) {
      ++row;
    }
    const double error_m = camera.column("y_camera_m")[i] - truth.column("y_carriage_m")[row];
    EXPECT_LT(std::fabs(error_m), 2.5e-4 + 5 * 2e-4);
    off_m += error_m * error_m;
  }
  const double rms_m = std::sqrt(off_m / static_cast<double>(camera.rows()));
  EXPECT_NEAR(rms_m, std::hypot(2e-4, 5e-4 / std::sqrt(12)), 3e-5);
}

TEST(SensorRecord, OfACameraThatLacksAFrameMakesTheRunInvalid) {
  const auto fixture = Runs::shipped("circle-watched");
  Runs runs;
  const auto run = runs.run(fixture);
  const auto whole = contents_of(run.folder / kCameraFile);
  const auto third_line = whole.find('\n', whole.find('\n') + 1) + 1;
  auto without = whole;
  without.erase(third_line, whole.find('\n', third_line) + 1 - third_line);
  for (const auto& text : {without, whole.substr(0, whole.rfind('\n', whole.size() - 2) + 1)}) {
    std::ofstream(run.folder / kCameraFile) << text;
    EXPECT_EQ(judge(run.folder, fixture, run.outcome).verdict, Verdict::kInvalid);
  }
}

TEST(SensorRecord, OfASensorThatIsNotFittedIsNotThere) {
  Runs runs;
  const auto run = runs.run("trapezoid-400");
  for (const auto& file : sensor_files()) {
    EXPECT_FALSE(std::filesystem::exists(run.folder / file)) << file;
    EXPECT_EQ(check_named(run, std::filesystem::path(file).stem().string() + "_complete"), nullptr);
  }
}

TEST(SensorRecord, ThatLacksASampleMakesTheRunInvalid) {
  const TemporaryFixtures files;
  const auto fixture = tow(files);
  Runs runs;
  const auto run = runs.run(fixture);
  ASSERT_EQ(run.judgement.verdict, Verdict::kPass) << complaints_of(run);
  const auto whole = contents_of(run.folder / kForceFile);
  const auto third_line = whole.find('\n', whole.find('\n') + 1) + 1;
  auto without = whole;
  without.erase(third_line, whole.find('\n', third_line) + 1 - third_line);
  for (const auto& [text, says] :
       {std::pair{without, "row 2"}, std::pair{whole.substr(0, whole.size() / 2), "torn"},
        std::pair{std::string(kForceHeader) + "\n", "no row"}}) {
    std::ofstream(run.folder / kForceFile) << text;
    const auto judged = judge(run.folder, fixture, run.outcome);
    EXPECT_EQ(judged.verdict, Verdict::kInvalid);
    const auto found = std::find_if(judged.checks.begin(), judged.checks.end(),
                                    [](const auto& c) { return c.name == "force_complete"; });
    ASSERT_NE(found, judged.checks.end());
    EXPECT_NE(found->reason.find(says), std::string::npos) << found->reason;
  }
  std::filesystem::remove(run.folder / kForceFile);
  EXPECT_EQ(judge(run.folder, fixture, run.outcome).verdict, Verdict::kInvalid);
}

}  // namespace
}  // namespace towbench::harness
