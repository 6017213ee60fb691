// Faults of the board and budgets of the image: judged both ways, refused where they cannot be.
#include <algorithm>
#include <chrono>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/experiment/board_plan_text.h"
#include "harness/fixtures/fixture_error.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

// In the last row at or before a time.
double carriage_at(const CsvTable& truth, double time_s) {
  const auto times_s = truth.column("time_s");
  const auto after = std::upper_bound(times_s.begin(), times_s.end(), time_s + 1e-9);
  return truth.column("y_carriage_m")[static_cast<std::size_t>(after - times_s.begin()) - 1];
}

class BoardPlanRun : public testing::Test {
 protected:
  BoardPlanRun() {
    std::filesystem::create_directory_symlink(std::filesystem::absolute("fixtures"),
                                              files_.folder() / "fixtures");
    options_.out = files_.folder() / "runs";
    options_.firmware = std::filesystem::path(TOWBENCH_FIRMWARE_FOLDER) / "servo.elf";
  }

  ExperimentFixture servo(const std::string& more = "") {
    return load_experiment(files_.write("servo.toml", R"(schema = 1
name = "servo"
rig = "fixtures/rigs/macs-nominal.toml"
controller = "fixtures/controllers/bbmc-0.5.toml"
duration_limit_s = 5.0
console = [
  { expect = "servo:~$ ", timeout_s = 5.0 },
  { send = "move", expect = "[Y/n]", timeout_s = 1.0 },
  { send = "Y", expect = "EOR", wait = "idle", timeout_s = 8.0 },
]
budget = [{ metric = "y_carriage_travel_m", min = 0.095, max = 0.105 }]
)" + more));
  }
  RunResult with_fault(const std::string& words) {
    auto fixture = servo();
    add_board_fault(fixture, parse_board_fault(words));
    return run_experiment(fixture, options_);
  }
  static std::string fired(const RunResult& run) {
    const Check* check = check_named(run, "board_fault_fired");
    return check == nullptr ? "no such check" : std::string(name_of(check->verdict));
  }

  TemporaryFixtures files_;
  RunOptions options_;
};

TEST_F(BoardPlanRun, ABrownOutStopsTheDriveAndTheImageStartsAgain) {
  const auto run = with_fault("board brown_out at=1.8s for=50ms");
  EXPECT_EQ(run.judgement.verdict, Verdict::kPass) << complaints_of(run);
  const auto console = contents_of(run.folder / "console.txt");
  EXPECT_NE(console.find("servo is up", console.find("EXECUTING")), std::string::npos) << console;
  EXPECT_EQ(console.find("EOR"), std::string::npos);
}

TEST_F(BoardPlanRun, AnImageThatDrivesAtOnceAfterABrownOutIsCaught) {
  options_.firmware =
      std::filesystem::path(TOWBENCH_FIRMWARE_FOLDER) / "servo-RESUMES_AFTER_RESET.elf";
  const auto sound = run_experiment(servo(), options_);
  EXPECT_EQ(sound.judgement.verdict, Verdict::kPass) << complaints_of(sound);
  const auto run = with_fault("board brown_out at=1.8s for=50ms");
  ASSERT_NE(check_named(run, "starts_undriven"), nullptr);
  EXPECT_EQ(check_named(run, "starts_undriven")->verdict, Verdict::kFail);
}

TEST_F(BoardPlanRun, AStuckBitFiresWhenARegisterIsReadWithTheOtherLevel) {
  EXPECT_EQ(fired(with_fault("board stuck_bit at=1.5s address=0x48302180 bit=12 high=true")),
            "PASS");
  EXPECT_EQ(fired(with_fault("board stuck_bit at=1.5s address=0x48304180 bit=3 high=true")),
            "INVALID")
      << "nobody reads that register";
}

TEST_F(BoardPlanRun, LostAndDelayedInterruptsFireOrAreInvalid) {
  EXPECT_EQ(fired(with_fault("board lost_interrupt at=1.5s interrupt=68 count=5")), "PASS");
  EXPECT_EQ(fired(with_fault("board delayed_interrupt at=1.5s interrupt=68 delay=200us for=1s")),
            "PASS");
  const auto run = with_fault("board lost_interrupt at=1.5s interrupt=12");
  EXPECT_EQ(fired(run), "INVALID");
  EXPECT_EQ(run.exit_code, kExitInvalid);
}

TEST_F(BoardPlanRun, AFaultInTheFileLeavesItsBudgetsInForce) {
  const auto run = run_experiment(servo(R"(
[[board_fault]]
do = "brown_out"
at_s = 1.8
)"),
                                  options_);
  EXPECT_EQ(run.judgement.verdict, Verdict::kFail) << "it did not travel 0.1 m";
  EXPECT_EQ(fired(run), "PASS");
}

TEST_F(BoardPlanRun, BudgetsOnInstructionsAndStackAreJudgedBothWays) {
  const auto plan = [](int instructions, int stack) {
    return "[[board_budget]]\nmetric = \"worst_instructions\"\ninterrupt = 68\nmax = " +
           std::to_string(instructions) +
           ".0\n[[board_budget]]\nmetric = \"stack_bytes\"\nmax = " + std::to_string(stack) +
           ".0\n";
  };
  EXPECT_EQ(run_experiment(servo(plan(2000, 8192)), options_).judgement.verdict, Verdict::kPass);
  const auto slow = run_experiment(servo(plan(100, 8192)), options_);
  EXPECT_EQ(check_named(slow, "interrupt_68_worst_instructions")->verdict, Verdict::kFail);
  EXPECT_EQ(slow.judgement.verdict, Verdict::kFail);
  const auto deep = run_experiment(servo(plan(2000, 64)), options_);
  EXPECT_EQ(check_named(deep, "stack_bytes")->verdict, Verdict::kFail);
}

TEST_F(BoardPlanRun, ABudgetOnAnInterruptThatNeverCameIsInvalid) {
  const auto run = run_experiment(
      servo("[[board_budget]]\nmetric = \"worst_instructions\"\ninterrupt = 10\nmax = 1.0\n"),
      options_);
  EXPECT_EQ(run.judgement.verdict, Verdict::kInvalid);
}

TEST_F(BoardPlanRun, WithoutTheBoardItIsRefused) {
  auto fixture = servo("[[board_budget]]\nmetric = \"stack_bytes\"\nmax = 1.0\n");
  RunOptions host;
  host.out = options_.out;
  EXPECT_THROW((void)run_experiment(fixture, host), FixtureError);
}

TEST_F(BoardPlanRun, FaultsOfTheMachineAreJudgedBesideTheSameImageWithoutThem) {
  auto fixture = servo(R"(
[[fault]]
component = "encoder.y"
kind = "frozen"
at_s = 1.8
)");
  fixture.experiment.budgets_apply = false;
  const auto run = run_experiment(fixture, options_);
  ASSERT_NE(check_named(run, "fault_fired"), nullptr) << complaints_of(run);
  EXPECT_EQ(check_named(run, "fault_fired")->verdict, Verdict::kPass);
  EXPECT_NEAR(check_named(run, "fault_fired")->value.value_or(0), 1.8, 0.01);
  auto late = servo("[[fault]]\ncomponent = \"encoder.y\"\nkind = \"frozen\"\nat_s = 30.0\n");
  late.experiment.budgets_apply = false;
  EXPECT_EQ(run_experiment(late, options_).judgement.verdict, Verdict::kInvalid)
      << "the run ends before it";
  auto link = servo("[[fault]]\ncomponent = \"link.to_plant\"\nkind = \"loss\"\nat_s = 1.0\n");
  EXPECT_THROW((void)run_experiment(link, options_), FixtureError);
}

TEST_F(BoardPlanRun, EachOfTwoFaultsOfTheMachineMustTakeEffect) {
  const auto second_at = [&](const char* time) {
    auto fixture = servo(
        "[[fault]]\ncomponent = \"encoder.y\"\nkind = \"frozen\"\nat_s = 1.8\n"
        "[[fault]]\ncomponent = \"kill_switch\"\nkind = \"pressed\"\nat_s = " +
        std::string(time) + "\n");
    fixture.experiment.budgets_apply = false;
    return run_experiment(fixture, options_);
  };
  const auto run = second_at("30.0");
  ASSERT_NE(check_named(run, "fault_1_fired"), nullptr) << complaints_of(run);
  ASSERT_NE(check_named(run, "fault_2_fired"), nullptr) << complaints_of(run);
  EXPECT_EQ(check_named(run, "fault_1_fired")->verdict, Verdict::kPass);
  EXPECT_EQ(check_named(run, "fault_2_fired")->verdict, Verdict::kInvalid);
  EXPECT_EQ(run.judgement.verdict, Verdict::kInvalid);
  EXPECT_EQ(check_named(second_at("1.9"), "fault_2_fired")->verdict, Verdict::kPass);
}

TEST_F(BoardPlanRun, MomentsAreFoundInTheSameImageWithoutTheFault) {
  const auto with = [&](const std::string& when) {
    auto fixture = servo("[[fault]]\ncomponent = \"encoder.y\"\nkind = \"frozen\"\n" + when + "\n");
    fixture.experiment.budgets_apply = false;
    return fixture;
  };
  const auto there = run_experiment(with("position_m = 0.5"), options_);
  ASSERT_NE(check_named(there, "fault_fired"), nullptr) << complaints_of(there);
  const auto truth = CsvTable::load(there.folder / "reference" / "truth.csv");
  const auto fired_s = check_named(there, "fault_fired")->value.value_or(0);
  EXPECT_NEAR(carriage_at(truth, fired_s), 0.5, 1e-3)
      << "the carriage was there, without the fault";
  EXPECT_THROW((void)run_experiment(with("position_m = 2.5"), options_), FixtureError)
      << "it never comes there";
  const auto slowing = run_experiment(with("phase = \"decelerate\""), options_);
  ASSERT_NE(check_named(slowing, "fault_fired"), nullptr) << complaints_of(slowing);
  EXPECT_EQ(check_named(slowing, "fault_fired")->verdict, Verdict::kPass)
      << "found in what the machine did: this image has no log of its own";
  EXPECT_THROW((void)run_experiment(with("event = \"fault\""), options_), FixtureError)
      << "only the image would know";
}

TEST_F(BoardPlanRun, AWeldedKillSwitchIsJudgedBesideASoundOneThatIsPressedToo) {
  const auto at = [&](const char* time) {
    auto fixture = servo("[[fault]]\ncomponent = \"kill_switch\"\nkind = \"welded\"\nat_s = " +
                         std::string(time) + "\n");
    fixture.experiment.budgets_apply = false;
    return run_experiment(fixture, options_);
  };
  const auto run = at("1.8");
  ASSERT_NE(check_named(run, "fault_fired"), nullptr) << complaints_of(run);
  EXPECT_EQ(check_named(run, "fault_fired")->verdict, Verdict::kPass);
  EXPECT_NE(contents_of(run.folder / "reference" / "console.txt").find("killed at"),
            std::string::npos);
  EXPECT_EQ(contents_of(run.folder / "console.txt").find("killed at"), std::string::npos);
}

TEST_F(BoardPlanRun, APersonTypesAtATerminalByTheWallClock) {
  auto fixture = servo();
  fixture.experiment.duration_limit_s = 1.0;
  options_.person_at_console = true;
  std::string seen;
  std::thread person;
  options_.watchers.terminal = [&](const std::string& path) {
    person = std::thread([&seen, path] {
      const int terminal = open(path.c_str(), O_RDWR | O_NOCTTY);
      const char* typed = "who\r";
      bool said = false;
      char byte = 0;
      while (seen.find("unknown command") == std::string::npos && seen.size() < 4096 &&
             read(terminal, &byte, 1) == 1) {
        seen += byte;
        if (!said && seen.find("servo:~$ ") != std::string::npos) {
          said = write(terminal, typed, 4) == 4;
        }
      }
      close(terminal);
    });
  };
  const auto start = std::chrono::steady_clock::now();
  const auto run = run_experiment(fixture, options_);
  const auto took = std::chrono::steady_clock::now() - start;
  person.join();
  EXPECT_NE(seen.find("error: unknown command"), std::string::npos) << seen;
  EXPECT_GE(took, std::chrono::milliseconds(950));
  EXPECT_EQ(run.judgement.verdict, Verdict::kInvalid) << "typed by hand: it proves nothing";
}

TEST(BoardFaultWords, ReadBackAsTheyWereWrittenAndRefuseWhatHasNoEffect) {
  for (const char* words : {"board brown_out at=2s for=0.05s",
                            "board stuck_bit at=2s address=0x4804C138 bit=14 high=false",
                            "board lost_interrupt at=2s interrupt=68 count=3",
                            "board delayed_interrupt at=2s interrupt=68 delay=0.001s"}) {
    EXPECT_EQ(describe(parse_board_fault(words)), words);
  }
  for (const char* words :
       {"board", "board melted at=1s", "board brown_out", "board brown_out at=1s bit=3",
        "board stuck_bit at=1s address=0x4804C139 bit=1", "board lost_interrupt at=1s",
        "board brown_out at=1s \"x=1"}) {
    EXPECT_THROW((void)parse_board_fault(words), FixtureError) << words;
  }
}

}  // namespace
}  // namespace towbench::harness
