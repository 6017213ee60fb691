// Images that nothing of the project has been made for (tests/board/foreign) against the machine,
// as a user runs his own.
#include <atomic>
#include <cstdio>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/end_to_end/run_support.h"
#include "tests/support/program_output.h"

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
                                         "controller = \"fixtures/controllers/bbmc-0.5.toml\"\n"
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

// What a shell's command prints, without its last line's end.
std::string printed_by(const std::string& command) {
  std::string text;
  FILE* const pipe = popen(command.c_str(), "r");
  for (int letter = pipe == nullptr ? EOF : fgetc(pipe); letter != EOF; letter = fgetc(pipe)) {
    text += static_cast<char>(letter);
  }
  text += pipe != nullptr && pclose(pipe) == 0 ? "" : "(failed)";
  return text;
}

TEST(ForeignImage, LiesInItsRunFolderAndReplaysFromThere) {
  Bench bench;
  const auto run = bench.run("traced", kServo, "servo.elf");
  const auto result = nlohmann::json::parse(contents_of(run.folder / "result.json"));
  const auto image = result.value("image", nlohmann::json::object());
  EXPECT_EQ(image.value("file", ""), "inputs/servo.elf");
  EXPECT_EQ(image.value("bytes", std::uintmax_t{0}),
            std::filesystem::file_size(kImages / "servo.elf"));
  EXPECT_EQ(image.value("sha256", "").substr(0, 64) + ' ',
            printed_by("sha256sum '" + (kImages / "servo.elf").string() + "'").substr(0, 65));
  const auto replay =
      tests::quoted(TOWBENCH_PROGRAM) + " replay '" + run.folder.string() + "' 2>&1";
  EXPECT_NE(printed_by(replay).find("log.csv       identical"), std::string::npos)
      << printed_by(replay);
  std::filesystem::copy_file(kImages / "mapped.elf", run.folder / "inputs" / "servo.elf",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_NE(printed_by(replay).find("servo.elf"), std::string::npos)
      << "another image is no replay";
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

// What nothing here computes is told, and proves nothing where the image goes by it.
TEST(ForeignImage, RegistersThatAreOnlyKeptAndAWatchdogAreToldInTheRun) {
  Bench bench;
  const auto after = [&](const char* letter) {
    return bench.run(std::string("letter-") + letter,
                     "console = [{ send = \"" + std::string(letter) + R"(", wait_s = 1.5 }]
budget = [{ metric = "y_hard_end_contacts", max = 0.0 }]
)",
                     "misbehave.elf");
  };
  const auto reason = [](const RunResult& run, const char* name) {
    const auto* check = check_named(run, name);
    return check == nullptr ? "no " + std::string(name) + complaints_of(run)
                            : std::string(name_of(check->verdict)) + ' ' + check->reason;
  };
  const auto writes = after("k");
  EXPECT_EQ(check_named(writes, "registers_modelled"), nullptr) << complaints_of(writes);
  const auto listed = contents_of(writes.folder / "board.json");
  for (const char* named : {"adc: register 0x40", "i2c0: register 0xa4", "uart1: register 0x0"}) {
    EXPECT_NE(listed.find(named), std::string::npos) << named << '\n' << listed;
  }
  const auto sample = after("a");
  EXPECT_EQ(sample.judgement.verdict, Verdict::kInvalid);
  EXPECT_NE(reason(sample, "registers_modelled").find("(sample_of)"), std::string::npos)
      << reason(sample, "registers_modelled");
  const auto capture = reason(after("c"), "registers_modelled");
  EXPECT_NE(capture.find("of ecap1"), std::string::npos) << capture;
  EXPECT_EQ(reason(after("d"), "no_watchdog_reset").substr(0, 4), "FAIL");
}

// Ctrl-C is how a person at the console ends a run.
TEST(ForeignImage, ARunOfAPersonAtTheConsoleEndsWhenStoppedAndProvesNothing) {
  TemporaryFixtures files;
  std::filesystem::create_directory_symlink(std::filesystem::absolute("fixtures"),
                                            files.folder() / "fixtures");
  const auto file = files.write("by-hand.toml", R"(
schema = 1
name = "by-hand"
rig = "fixtures/rigs/macs-nominal.toml"
controller = "fixtures/controllers/bbmc-0.5.toml"
duration_limit_s = 10.0
budget = [{ metric = "y_carriage_travel_m", max = 0.105 }]
)");
  const std::atomic<bool> stop{true};
  RunOptions options;
  options.out = files.folder() / "runs";
  options.firmware = kImages / "servo.elf";
  options.person_at_console = true;
  options.watchers.stop = &stop;
  const auto run = run_experiment(load_experiment(file), options);
  EXPECT_TRUE(run.complete) << run.reason;
  EXPECT_EQ(run.judgement.verdict, Verdict::kInvalid);
  EXPECT_NE(check_named(run, "driven_by_hand"), nullptr) << complaints_of(run);
  for (const auto& check : run.judgement.checks) {
    EXPECT_NE(check.verdict, Verdict::kFail) << check.name << ": " << check.reason;
  }
  const auto replay =
      tests::quoted(TOWBENCH_PROGRAM) + " replay '" + run.folder.string() + "' 2>&1";
  EXPECT_NE(printed_by(replay).find("is not played again"), std::string::npos)
      << printed_by(replay);
}

// What the image does is right, and its pins are not where it looks for them.
TEST(ForeignImage, AWiringFileSaysWhichPinsMeetTheMachine) {
  TemporaryFixtures files;
  std::filesystem::create_directory_symlink(std::filesystem::absolute("fixtures"),
                                            files.folder() / "fixtures");
  const auto wired = [&](const std::string& wiring, const std::string& event) {
    (void)files.write("wiring.toml", "schema = 1\n" + wiring);
    const auto file = files.write("wired.toml", R"(
schema = 1
name = "wired"
rig = "fixtures/rigs/macs-nominal.toml"
controller = "fixtures/controllers/bbmc-0.5.toml"
wiring = "wiring.toml"
duration_limit_s = 10.0
console = [
  { expect = "servo:~$ ", timeout_s = 5.0 },
  { send = "move", expect = "[Y/n]", timeout_s = 1.0 },
  { send = "Y", expect = "at ", timeout_s = 8.0 },
]
budget = [{ metric = "y_carriage_travel_m", max = 0.105 }]
)" + event);
    RunOptions options;
    options.out = files.folder() / "runs";
    options.firmware = kImages / "servo.elf";
    return run_experiment(load_experiment(file), options);
  };
  const auto has = [](const RunResult& run, const char* words) {
    return contents_of(run.folder / "console.txt").find(words) != std::string::npos;
  };
  const std::string pressed = "event = [{ at_s = 1.8, do = \"press_kill_switch\" }]\n";
  EXPECT_TRUE(has(wired("", pressed), "killed at"));
  const auto deaf = wired("kill_switch = \"gpio2.14\"\n", pressed);
  ASSERT_NE(check_named(deaf, "kill_to_zero_duty"), nullptr) << complaints_of(deaf);
  EXPECT_EQ(check_named(deaf, "kill_to_zero_duty")->verdict, Verdict::kFail);
  EXPECT_TRUE(has(wired("[axis.y]\nhall_max = \"!gpio1.17\"\n", ""), "end-stop at"));
  EXPECT_TRUE(has(wired("[axis.y]\nchannels = \"b_towards_max\"\n", ""), "lost at"))
      << "it drives the other way";
  EXPECT_TRUE(has(wired("[axis.y]\nencoder = \"eqep0\"\n", ""), "stalled at"))
      << "its count stands";
  const auto kept = wired("[axis.x]\nencoder = \"eqep0\"\n", "");
  EXPECT_TRUE(std::filesystem::exists(kept.folder / "inputs" / "wiring.toml"));
  RunOptions without;
  without.out = files.folder() / "runs";
  EXPECT_THROW((void)run_experiment(load_experiment(files.folder() / "wired.toml"), without),
               FixtureError)
      << "BBMC on the bench has no pins";
}

}  // namespace
}  // namespace towbench::harness
