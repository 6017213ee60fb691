// The whole controller on kernel devices: a closed loop around the emulated machine through files,
// and what it does when a device fails.
#include "bbmc/host/linux/linux_node.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <memory>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/bbmc/support/fake_board.h"
#include "tests/bbmc/support/fake_board_machine.h"

namespace towbench::bbmc {
namespace {

using core::Axis;
using core::ErrorCode;
using tests::FakeBoard;
using tests::FakeBoardMachine;

constexpr double kStart_m = 1.0;

Configuration without_index() {
  Configuration configuration;
  for (Axis axis : core::kPlanarAxes) {
    configuration.axes[axis].plausibility.index_fitted = false;
  }
  // bbmc-tuned.toml
  configuration.axes[Axis::kY].gains = {0.05, 0.5, 6e-4};
  configuration.axes[Axis::kX].gains = {0.02, 0.2, 2e-4};
  return configuration;
}

emulator::RigParameters standing_rig() {
  emulator::RigParameters rig;
  rig.axes[Axis::kY].start_m = kStart_m;
  rig.axes[Axis::kX].start_m = 0.3;
  return rig;
}

class LinuxNodeTest : public ::testing::Test {
 protected:
  void start() {
    const auto status = node_.start(fake_.devices());
    ASSERT_TRUE(status) << node_.trouble();
    machine_ = std::make_unique<FakeBoardMachine>(fake_, standing_rig(), node_.exchange_ns());
    serve();
    run_for(0.01);
    command("reset poscalib y 1m");
    ASSERT_TRUE(said("ok")) << console_;
    command("reset poscalib x 0.3m");
    ASSERT_TRUE(said("ok")) << console_;
  }
  void serve() {
    good_ = node_.serve(machine_->now_ns());
    std::array<char, 256> bytes{};
    while (const std::size_t count = node_.read_console(bytes)) {
      console_.append(bytes.data(), count);
    }
    TelemetryRow row;
    while (node_.next_row(row)) {
      rows_.push_back(row);
    }
  }
  void exchange() {
    machine_->step();
    serve();
  }
  void run_for(double duration_s) {
    const auto until_ns = machine_->now_ns() + core::nanoseconds(duration_s);
    while (machine_->now_ns() < until_ns) {
      exchange();
    }
  }
  // Types a line and waits until it has been carried out.
  void command(const std::string& line) {
    console_.clear();
    ASSERT_EQ(node_.type(line + '\r'), line.size() + 1);
    exchange();
    for (int i = 0; i < 60'000 && !node_.idle(); ++i) {
      exchange();
    }
  }
  [[nodiscard]] bool said(const char* text) const {
    return console_.find(text) != std::string::npos;
  }

  FakeBoard fake_;
  LinuxNode node_{without_index(), 0};
  std::unique_ptr<FakeBoardMachine> machine_;
  std::string console_;
  std::vector<TelemetryRow> rows_;
  bool good_ = true;
};

TEST_F(LinuxNodeTest, ATrapezoidThroughFilesMovesTheCarriageByItsDistance) {
  start();
  const double before_m = machine_->truth.back().axes[Axis::kY].carriage_m;
  rows_.clear();
  command("run -trapez y --distance 0.3m --speed 0.1m/s");
  EXPECT_TRUE(said("done")) << console_;
  EXPECT_EQ(node_.status().fault, ErrorCode::kNone);
  const double moved_m = machine_->truth.back().axes[Axis::kY].carriage_m - before_m;
  EXPECT_NEAR(moved_m, 0.3, 1e-3);
  EXPECT_FALSE(machine_->touched_a_hard_end);
  double worst_m = 0;
  for (const TelemetryRow& row : rows_) {
    const AxisTelemetry& y = row.axes[Axis::kY];
    if (y.mode == AxisMode::kPosition) {
      worst_m = std::max(worst_m, std::fabs(y.reference_m - y.position_m));
    }
  }
  // TRK-2: the whole profile within 1 mm with the plain PID.
  EXPECT_GT(worst_m, 0.0);
  EXPECT_LT(worst_m, 1e-3);
  EXPECT_TRUE(fake_.is_safe()) << "at rest nothing is put out";
}

TEST_F(LinuxNodeTest, StartingSetsTheCountersUp) {
  start();
  const std::string count = FakeBoard::count_file(Axis::kX);
  const std::string folder = count.substr(0, count.rfind('/') + 1);
  EXPECT_EQ(fake_.first_line(folder + "function"), "quadrature x4");
  EXPECT_EQ(fake_.read(folder + "ceiling"), 4294967295U);
  EXPECT_EQ(fake_.read(folder + "enable"), 1U);
}

TEST_F(LinuxNodeTest, TheKillSwitchTakesTheDriveInTheExchangeInWhichItIsSeen) {
  start();
  ASSERT_GT(node_.type("run -trapez y --distance 0.5m --speed 0.2m/s\r"), 0U);
  run_for(2.0);
  ASSERT_FALSE(fake_.is_safe());
  machine_->press_kill_switch();
  exchange();
  EXPECT_TRUE(fake_.is_safe());
  EXPECT_EQ(node_.status().fault, ErrorCode::kFaultKillSwitch);
}

TEST_F(LinuxNodeTest, AnEncoderThatCannotBeReadStopsEverythingAtOnceAndIsTold) {
  start();
  ASSERT_GT(node_.type("run -circle --radius 0.1m --period 5s --turns 1\r"), 0U);
  run_for(1.5);
  ASSERT_FALSE(fake_.is_safe());
  machine_->step();
  fake_.write(FakeBoard::count_file(Axis::kX), "");
  serve();
  EXPECT_FALSE(good_);
  EXPECT_TRUE(fake_.is_safe());
  EXPECT_EQ(node_.status().fault, ErrorCode::kFaultLinkLost);
  EXPECT_TRUE(node_.trouble().ends_with("count holds no number")) << node_.trouble();
}

TEST_F(LinuxNodeTest, ADutyThatCannotBeWrittenStopsTheOtherAxisToo) {
  const auto seal = fake_.sealable(FakeBoard::pwm_file(Axis::kY, 0, "duty_cycle"));
  start();
  ASSERT_GT(node_.type("run -circle --radius 0.1m --period 5s --turns 1\r"), 0U);
  run_for(1.5);
  ASSERT_FALSE(fake_.is_safe());
  seal.close_for_writing();
  for (int i = 0; i < 2000 && good_; ++i) {
    exchange();
  }
  ASSERT_FALSE(good_);
  EXPECT_EQ(fake_.read(FakeBoard::pwm_file(Axis::kY, 0, "enable")), 0U);
  EXPECT_EQ(fake_.read(FakeBoard::pwm_file(Axis::kX, 0, "duty_cycle")), 0U);
  EXPECT_EQ(fake_.read(FakeBoard::pwm_file(Axis::kX, 0, "enable")), 0U);
  EXPECT_EQ(fake_.read(FakeBoard::line_file(Line::kAmplifierEnableY)), 0U);
  EXPECT_EQ(node_.status().fault, ErrorCode::kFaultLinkLost);
}

TEST_F(LinuxNodeTest, ADeviceThatComesBackIsUsedAgainOnlyAfterAReset) {
  start();
  machine_->step();
  fake_.write(FakeBoard::line_file(Line::kHallYMin), "x\n");
  serve();
  ASSERT_FALSE(good_);
  exchange();  // the machine writes a level again
  EXPECT_TRUE(good_);
  command("run -trapez y --distance 0.1m --speed 0.1m/s");
  EXPECT_TRUE(said("error 204")) << console_;
  command("reset");
  command("run -trapez y --distance 0.1m --speed 0.1m/s");
  EXPECT_TRUE(said("done")) << console_;
}

TEST_F(LinuxNodeTest, AnOrderlyEndPutsNothingOut) {
  start();
  ASSERT_GT(node_.type("run -trapez y --distance 0.5m --speed 0.2m/s\r"), 0U);
  run_for(2.0);
  ASSERT_FALSE(fake_.is_safe());
  node_.finish();
  EXPECT_TRUE(fake_.is_safe());
}

TEST(LinuxNodeStart, ABoardThatCannotBeSetUpIsLeftSafe) {
  FakeBoard fake;
  fake.refuse_the_value(FakeBoard::pwm_file(Axis::kX, 1, "period"));
  fake.write(FakeBoard::pwm_file(Axis::kY, 0, "duty_cycle"), 9000);
  LinuxNode node(without_index(), 0);
  EXPECT_EQ(node.start(fake.devices()).error(), ErrorCode::kDeviceBadArgument);
  EXPECT_TRUE(fake.is_safe());
}

TEST(LinuxNodeStart, DevicesThatTheControllerCountsOnMustBeNamed) {
  const FakeBoard fake;
  EXPECT_EQ(inconsistency(fake.devices(), without_index()), nullptr);
  EXPECT_NE(inconsistency(fake.devices(), Configuration()), nullptr) << "nothing reports the index";
  LinuxDevices devices = fake.devices();
  devices.axes[Axis::kX].hall_max.clear();
  EXPECT_NE(inconsistency(devices, without_index()), nullptr);
  devices = fake.devices();
  devices.kill_switch.clear();
  EXPECT_NE(inconsistency(devices, without_index()), nullptr);
  devices = fake.devices();
  devices.axes[Axis::kX].encoder.counter.clear();
  EXPECT_NE(inconsistency(devices, without_index()), nullptr);
}

// The guard is a process and lives by the wall clock; these wait for it, with a limit.
class DriveGuardTest : public ::testing::Test {
 protected:
  void start(core::Nanoseconds patience_ns) {
    ASSERT_TRUE(node_.start(fake_.devices(), 0, patience_ns)) << node_.trouble();
    fake_.write(FakeBoard::pwm_file(Axis::kX, 0, "duty_cycle"), 5000);
    fake_.write(FakeBoard::pwm_file(Axis::kX, 0, "enable"), 1);
  }
  bool becomes_safe() {
    using std::chrono::steady_clock;
    const auto limit = steady_clock::now() + std::chrono::seconds(20);
    while (!fake_.is_safe() && steady_clock::now() < limit) {
      std::this_thread::yield();
    }
    return fake_.is_safe();
  }
  FakeBoard fake_;
  LinuxNode node_{without_index(), 0};
};

TEST_F(DriveGuardTest, TakesTheDriveFromAControllerThatIsNotServed) {
  start(20'000'000);
  EXPECT_TRUE(becomes_safe());
  // And the controller that comes back finds it gone, and stays off.
  core::Nanoseconds now_ns = 0;
  while (node_.serve(now_ns) && now_ns < 100'000'000'000) {
    now_ns += 1'000'000;
  }
  EXPECT_EQ(node_.status().fault, ErrorCode::kFaultLinkLost);
  EXPECT_TRUE(node_.trouble().starts_with("the drive guard took the drive away"));
}

TEST_F(DriveGuardTest, TakesTheDriveFromAControllerThatIsKilled) {
  const pid_t controller = ::fork();
  if (controller == 0) {
    LinuxNode node(without_index(), 0);
    if (node.start(fake_.devices(), 0, 3'600'000'000'000)) {
      fake_.write(FakeBoard::pwm_file(Axis::kX, 0, "duty_cycle"), 5000);
      fake_.write(FakeBoard::pwm_file(Axis::kX, 0, "enable"), 1);
      ::kill(::getpid(), SIGKILL);
    }
    ::_exit(1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(controller, &status, 0), controller);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_TRUE(becomes_safe());
}

TEST_F(DriveGuardTest, LeavesWithAnOrderlyEnd) {
  start(3'600'000'000'000);
  node_.finish();  // waits for the guard: an hour of patience would show
  EXPECT_TRUE(fake_.is_safe());
}

}  // namespace
}  // namespace towbench::bbmc
