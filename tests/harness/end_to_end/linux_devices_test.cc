// `towbench control --devices`: the verb as a process on a folder that imitates a board.
#include <array>
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/checks/check.h"
#include "harness/fixtures/linux_devices_fixture.h"
#include "tests/harness/fixtures/temporary_fixtures.h"
#include "tests/support/program_output.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

constexpr const char* kCounts = "/counter/counter1/count0/";
constexpr const char* kChip = "/pwm/pwmchip4/";

class LinuxDevicesTest : public ::testing::Test {
 protected:
  LinuxDevicesTest() {
    for (const char* file : {"count", "ceiling", "enable", "function"}) {
      node(kCounts, file);
    }
    for (const char* channel : {"pwm0/", "pwm1/"}) {
      for (const char* file : {"period", "duty_cycle", "polarity", "enable"}) {
        node(std::string(kChip) + channel, file);
      }
    }
    for (const char* line : {"min", "max", "ready", "enable", "kill"}) {
      node("/lines/", line);
    }
    board_.write("controller.toml",
                 "schema = 1\nname = \"y\"\n[axis.y]\nplausibility = { index_fitted = false }\n"
                 "[axis.x]\nexists = false\n");
    board_.write("devices.toml",
                 "schema = 1\nname = \"fake\"\nroot = \"" + board_.folder().string() +
                     "\"\nkill_switch = \"/lines/kill\"\nguard_patience_s = 1.0\n[axis.y]\n"
                     "encoder = { counter = \"/counter/counter1\" }\nhall_min = \"/lines/min\"\n"
                     "hall_max = \"/lines/max\"\namplifier_ready = \"/lines/ready\"\n"
                     "amplifier_enable = \"/lines/enable\"\n[axis.y.pwm]\n"
                     "towards_max = { chip = \"/pwm/pwmchip4\", channel = 0 }\n"
                     "towards_min = { chip = \"/pwm/pwmchip4\", channel = 1 }\n");
  }
  void node(const std::string& folder, const std::string& name) const {
    board_.write((folder + name).substr(1), "0\n");
  }
  [[nodiscard]] std::string value(const std::string& node) const {
    std::string line;
    std::ifstream in(board_.folder().string() + node);
    std::getline(in, line);
    return line;
  }
  // The exit code; what was said is in said_.
  int control(const std::string& typed, const std::string& devices) {
    const std::string command = "printf '" + typed + "' | " + tests::quoted(TOWBENCH_PROGRAM) +
                                " control --controller " + file("controller.toml") + " --devices " +
                                devices + " 2>&1";
    std::FILE* pipe = popen(command.c_str(), "r");
    std::array<char, 4096> bytes{};
    for (std::size_t count = 0; (count = fread(bytes.data(), 1, bytes.size(), pipe)) > 0;) {
      said_.append(bytes.data(), count);
    }
    return WEXITSTATUS(pclose(pipe));
  }
  [[nodiscard]] std::string file(const char* name) const {
    return (board_.folder() / name).string();
  }

  TemporaryFixtures board_;
  std::string said_;
};

TEST_F(LinuxDevicesTest, ASessionSetsTheDevicesUpAndLeavesNothingOn) {
  EXPECT_EQ(control("status\\nreset poscalib y 1m\\ntest devices\\nquit\\n",
                    "linux:" + file("devices.toml")),
            kExitPass)
      << said_;
  EXPECT_THAT(said_, HasSubstr("ehrpwm y                ready"));
  EXPECT_THAT(said_, HasSubstr("reset poscalib y 1m\r\nok"));
  EXPECT_EQ(value(std::string(kCounts) + "function"), "quadrature x4");
  EXPECT_EQ(value(std::string(kChip) + "pwm0/period"), "10000");
  EXPECT_EQ(value(std::string(kChip) + "pwm0/duty_cycle"), "0");
  EXPECT_EQ(value(std::string(kChip) + "pwm1/enable"), "0");
  EXPECT_EQ(value("/lines/enable"), "0");
}

TEST_F(LinuxDevicesTest, AMissingNodeEndsItWithTheNodeAndANumber) {
  std::filesystem::remove(board_.folder().string() + kChip + "pwm1/duty_cycle");
  EXPECT_EQ(control("", "linux:" + file("devices.toml")), kExitRuntime);
  EXPECT_THAT(said_, HasSubstr("error 100, cannot open "));
  EXPECT_THAT(said_, HasSubstr("pwm1/duty_cycle: No such file or directory"));
}

TEST_F(LinuxDevicesTest, NothingIsTouchedThatTheFileDoesNotName) {
  board_.write("devices.toml", "schema = 1\nname = \"none\"\n");
  EXPECT_EQ(control("", "linux:" + file("devices.toml")), kExitBadInput);
  EXPECT_THAT(said_, HasSubstr("kill_switch must be named"));
  EXPECT_EQ(control("", "windows:x"), kExitBadInput);
}

TEST(LinuxDevicesFixtureTest, TheBoardsFileIsReadWhole) {
  const auto board = load_linux_devices("fixtures/devices/beaglebone.toml");
  const auto& x = board.devices.axes[core::Axis::kX];
  EXPECT_EQ(x.encoder.counter, "/sys/bus/counter/devices/counter2");
  EXPECT_EQ(x.pwm.towards_min.chip, "/sys/class/pwm/pwmchip7");
  EXPECT_EQ(x.pwm.towards_min.channel, 1U);
  EXPECT_EQ(x.hall_min, "gpiochip1:2");
  EXPECT_EQ(board.devices.kill_switch, "gpiochip1:14");
  EXPECT_TRUE(board.devices.root.empty());
}

TEST(LinuxDevicesFixtureTest, AMisspeltKeyIsRefused) {
  const auto file = FixtureFile::parse(
      "schema = 1\n[axis.y]\nencoder = { counter = \"/c\", inverse = true }\n", "devices.toml");
  EXPECT_THROW((void)read_linux_devices(file), FixtureError);
}

}  // namespace
}  // namespace towbench::harness
