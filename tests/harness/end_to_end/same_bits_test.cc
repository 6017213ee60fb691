// One process, two processes and a replay leave the same bytes.
#include <gtest/gtest.h>

#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

class SameBits : public ::testing::TestWithParam<const char*> {};

void expect_same_records(const RunResult& a, const RunResult& b) {
  for (const char* file : {"log.csv", "truth.csv", "events.jsonl", "console.txt"}) {
    const auto of_a = contents_of(a.folder / file);
    EXPECT_FALSE(of_a.empty()) << file;
    EXPECT_TRUE(of_a == contents_of(b.folder / file)) << file;
  }
}

TEST_P(SameBits, InOneProcessAndInTwo) {
  Runs runs;
  const auto one = runs.run(GetParam());
  const auto two = runs.run(GetParam(), Carrier::kLocal);
  EXPECT_EQ(two.exit_code, kExitPass) << complaints_of(two);
  EXPECT_EQ(json_of(two.folder / "result.json").at("carrier"), "local");
  expect_same_records(one, two);
}

TEST_P(SameBits, ReplayedFromTheFolderAlone) {
  Runs runs;
  const auto recorded = runs.run(GetParam());
  // From the copies: the fixtures may have changed since.
  const auto copy =
      recorded.folder / json_of(recorded.folder / "result.json").at("experiment").at("file");
  const auto replayed = runs.run(load_experiment(copy));
  expect_same_records(recorded, replayed);
}

// A line that is active before anything runs is known at time 0 on every carrier.
TEST(SameBitsAtTheStart, AHallSensorThatIsActiveAtTimeZero) {
  const TemporaryFixtures files;
  std::filesystem::copy("fixtures", files.folder(), std::filesystem::copy_options::recursive);
  auto text = contents_of("fixtures/experiments/pulses.toml");
  const std::string start = "y_m = 0.449092";
  text.replace(text.find(start), start.size(), "y_m = 3.92");
  const auto fixture = load_experiment(files.write("experiments/pulses.toml", text));
  Runs runs;
  expect_same_records(runs.run(fixture), runs.run(fixture, Carrier::kLocal));
}

INSTANTIATE_TEST_SUITE_P(Experiments, SameBits,
                         ::testing::Values("circle", "endstop-y-max", "kill-10hz"),
                         [](const auto& each) {
                           std::string name = each.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace towbench::harness
