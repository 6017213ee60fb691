// Images that nothing of the project has been made for (tests/board/foreign) against the machine,
// as a user runs his own.
#include <gtest/gtest.h>

#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

const std::filesystem::path kImages = TOWBENCH_FIRMWARE_FOLDER;

// The user's file of docs/guide/run-your-firmware.md, beside the fixtures.
class Bench {
 public:
  Bench() {
    std::filesystem::create_directory_symlink(std::filesystem::absolute("fixtures"),
                                              files_.folder() / "fixtures");
  }
  RunResult run(const std::string& name, const std::string& script, const std::string& image) {
    const auto file =
        files_.write(name + ".toml", "schema = 1\nname = \"" + name +
                                         "\"\nrig = \"fixtures/rigs/macs-nominal.toml\"\n"
                                         "controller = \"fixtures/controllers/bbmc-default.toml\"\n"
                                         "duration_limit_s = 10.0\n" +
                                         script);
    RunOptions options;
    options.out = files_.folder() / "runs";
    options.firmware = kImages / image;
    return run_experiment(load_experiment(file), options);
  }

 private:
  TemporaryFixtures files_;
};

constexpr const char* kServo = R"(
console = [
  { expect = "servo:~$ ", timeout_s = 5.0, wait_s = 2.0 },
  { send = "move", expect = "[Y/n]", timeout_s = 1.0 },
  { send = "Y", expect = "EOR", wait = "idle", timeout_s = 8.0 },
]
budget = [
  { metric = "y_carriage_travel_m", min = 0.095, max = 0.105 },
  { metric = "y_hard_end_contacts", max = 0.0 },
]
)";

TEST(ForeignImage, AServoLoopWithNestedInterruptsAndPolledConsoleMovesTheCarriage) {
  Bench bench;
  const auto run = bench.run("servo", kServo, "servo.elf");
  EXPECT_EQ(run.judgement.verdict, Verdict::kPass) << complaints_of(run);
  const auto console = contents_of(run.folder / "console.txt");
  // The image's own count of its own encoder, 0.1 m on: what it logged is not asked.
  const auto at = console.find("EOR at ");
  ASSERT_NE(at, std::string::npos) << console;
  EXPECT_NEAR(std::stod(console.substr(at + 7)), 200'000 + 0.1 * 445'311, 600) << console;
  EXPECT_NE(console.find("ticks 3000"), std::string::npos) << "one tick each millisecond";
}

TEST(ForeignImage, TwoRunsAreTheSameToTheLastByte) {
  Bench bench;
  const auto first = bench.run("servo", kServo, "servo-stripped.elf");
  const auto second = bench.run("servo-again", kServo, "servo.elf");
  for (const char* file : {"log.csv", "truth.csv", "console.txt"}) {
    EXPECT_EQ(contents_of(first.folder / file), contents_of(second.folder / file))
        << file << ": symbols change nothing";
  }
}

TEST(ForeignImage, TheKillSwitchReachesItThroughItsOwnInterrupt) {
  Bench bench;
  const auto run = bench.run("killed", R"(
console = [
  { expect = "servo:~$ ", timeout_s = 5.0 },
  { send = "move", expect = "[Y/n]", timeout_s = 1.0 },
  { send = "Y", expect = "killed at", wait = "idle", timeout_s = 8.0 },
]
event = [{ at_s = 1.8, do = "press_kill_switch" }]
budget = [{ metric = "y_carriage_travel_m", max = 0.09 }]
)",
                             "servo.elf");
  EXPECT_EQ(run.judgement.verdict, Verdict::kPass) << complaints_of(run);
}

TEST(ForeignImage, MappedMemoryInterruptDrivenConsoleAndADirectionPinWork) {
  Bench bench;
  const auto run = bench.run("mapped", R"(
console = [
  { expect = "mapped\r\n? ", timeout_s = 5.0 },
  { send = "f", expect = "? ", timeout_s = 3.0 },
  { send = "s", expect = "at ", timeout_s = 1.0 },
  { send = "b", expect = "? ", timeout_s = 3.0, wait = "idle" },
]
budget = [
  { metric = "y_carriage_travel_m", min = 0.1 },
  { metric = "y_hard_end_contacts", max = 0.0 },
]
)",
                             "mapped-stripped.elf");
  EXPECT_EQ(run.judgement.verdict, Verdict::kPass) << complaints_of(run);
}

TEST(ForeignImage, OneThatGoesWrongFailsWithThePlaceAndAMissingPromptWithTheStep) {
  Bench bench;
  const auto crash = bench.run("crash", R"(
console = [{ send = "r", expect = "never", timeout_s = 1.0 }]
budget = [{ metric = "y_hard_end_contacts", max = 0.0 }]
)",
                               "misbehave.elf");
  ASSERT_NE(check_named(crash, "console_script"), nullptr);
  EXPECT_EQ(check_named(crash, "console_script")->verdict, Verdict::kFail);
  const auto& reason = check_named(crash, "console_script")->reason;
  EXPECT_NE(reason.find("(read_of): it reads 0x70000008"), std::string::npos) << reason;
  const auto silent = bench.run("silent", R"(
console = [{ expect = "> ", timeout_s = 1.0 }]
budget = [{ metric = "y_hard_end_contacts", max = 0.0 }]
)",
                                "misbehave.elf");
  EXPECT_NE(check_named(silent, "console_script")->reason.find("did not come within 1 s"),
            std::string::npos);
}

}  // namespace
}  // namespace towbench::harness
