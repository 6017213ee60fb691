// Faults that need a process, a wire or a disk of their own, done for real: a signal that nobody
// can catch, pseudo-terminals, a kernel that refuses to write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fault_cases/faulted_experiment.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/fixture_error.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

ExperimentFixture broken(const std::string& words) {
  auto fixture = Runs::shipped("trapezoid-400");
  add_faults(fixture, {parse_fault(words)});
  return fixture;
}

TEST(FullDisk, LeavesTheMotionAloneAndNeverPassesForAWholeRecord) {
  Runs runs;
  const auto run = runs.run(broken("host full_disk at=2s"));
  EXPECT_EQ(run.exit_code, kExitPass) << complaints_of(run);
  EXPECT_FALSE(run.outcome.writes_succeeded);
  EXPECT_EQ(check_named(run, "fault_fired")->verdict, Verdict::kPass);
  EXPECT_EQ(check_named(run, "torn_record_is_no_pass")->verdict, Verdict::kPass);
  ASSERT_TRUE(run.faults.has_value());
  EXPECT_FALSE(run.faults->detected);
  // The log ends where the disk did; the verdict could still be written.
  const auto log = CsvTable::load(run.folder / "log.csv");
  EXPECT_LT(log.column("time_s").back(), 3.0);
  EXPECT_GT(log.column("time_s").back(), 0.5);
}

TEST(FullDisk, ThatComesAfterTheEndHasNotFired) {
  Runs runs;
  EXPECT_EQ(runs.run(broken("host full_disk at=300s")).exit_code, kExitInvalid);
}

TEST(KilledHost, LeavesAReadableRecordAndAPlantWithoutDrive) {
  for (const auto carrier : {Carrier::kLocal, Carrier::kSerialPty}) {
    Runs runs;
    const auto run = runs.run(broken("host killed_while_logging at=2s"), carrier);
    EXPECT_EQ(run.exit_code, kExitPass) << complaints_of(run);
    const auto events = contents_of(run.folder / "events.jsonl");
    EXPECT_THAT(events, HasSubstr("drive_removed"));
    // To the last exchange that the controller asked for.
    EXPECT_NEAR(CsvTable::load(run.folder / "truth.csv").column("time_s").back(), 2.0, 2.1e-3);
  }
}

TEST(PlantProcess, KilledForRealIsFoundOverEachCarrier) {
  for (const auto carrier : {Carrier::kLocal, Carrier::kSerialPty}) {
    Runs runs;
    const auto run = runs.run(broken("link.to_controller peer_killed at=2s"), carrier);
    EXPECT_EQ(run.exit_code, kExitPass) << complaints_of(run);
    EXPECT_THAT(contents_of(run.folder / "events.jsonl"),
                HasSubstr(R"("kind":"fault_latched","axis":"y","code":320)"));
  }
}

TEST(PlantProcess, StartedAnewOnTheLineIsNotTakenForTheOldOne) {
  Runs runs;
  const auto run = runs.run(broken("link.to_controller peer_restart at=2s"), Carrier::kSerialPty);
  EXPECT_EQ(run.exit_code, kExitPass) << complaints_of(run);
  EXPECT_THAT(contents_of(run.folder / "events.jsonl"), HasSubstr("\"code\":320"));
}

TEST(SerialLine, WithTwoBaudRatesIsFoundAndTheBitsBeforeAreTheSame) {
  Runs runs;
  const auto fixture = broken("link.to_plant baud_mismatch at=2s");
  const auto wire = runs.run(fixture, Carrier::kSerialPty);
  const auto memory = runs.run(fixture);
  EXPECT_EQ(wire.exit_code, kExitPass) << complaints_of(wire);
  EXPECT_TRUE(contents_of(wire.folder / "log.csv") == contents_of(memory.folder / "log.csv"));
}

TEST(Carriers, RefuseWhatTheyCannotHaveInOneLine) {
  struct Refused {
    const char* words;
    Carrier carrier;
  };
  Runs runs;
  for (const auto& [words, carrier] :
       {Refused{"link.to_controller bus_off at=2s", Carrier::kLocal},
        Refused{"link.to_controller bus_off at=2s", Carrier::kSerialPty},
        Refused{"link.to_controller baud_mismatch at=2s", Carrier::kLocal},
        Refused{"link.to_controller peer_restart at=2s", Carrier::kLocal},
        Refused{"host killed_while_logging at=2s", Carrier::kInProcess}}) {
    try {
      (void)runs.run(broken(words), carrier);
      ADD_FAILURE() << words << " was accepted";
    } catch (const FixtureError& error) {
      const std::string kind(words, std::string(words).find(" at="));
      EXPECT_THAT(error.what(), HasSubstr(kind));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace towbench::harness
