// Faults as points of a box, what a search of them covered, and that one which was interrupted goes
// on.
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/falsify/falsify_report.h"
#include "harness/falsify/objective.h"
#include "harness/fault_plan/fault_text.h"
#include "tests/harness/end_to_end/run_support.h"
#include "tests/support/program_output.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

constexpr core::PerAxis<bool> kBoth{{true, true}};

TEST(FaultSpace, OfEveryKindGivesPlansThatCanBeWrittenAndRead) {
  const auto choices = fault_choices({}, kBoth);
  EXPECT_GT(choices.size(), 60U);
  for (const auto& choice : choices) {
    const FaultSpace space({choice}, 10);
    for (const double share : {0.0, 0.31, 0.79, 0.81, 1.0}) {
      const auto plan = space.plan_at(BoxPoint(space.variables().size(), share));
      ASSERT_EQ(plan.size(), 1U);
      EXPECT_EQ(describe(parse_fault(describe(plan.front()))), describe(plan.front()));
      EXPECT_LE(plan.front().trigger.value, 10.0);
    }
  }
}

TEST(FaultSpace, IsChosenByKindPlaceOrBoth) {
  EXPECT_EQ(fault_choices({"encoder.y frozen"}, kBoth).size(), 1U);
  EXPECT_EQ(fault_choices({"frozen"}, kBoth).size(), 2U);
  EXPECT_EQ(fault_choices({"frozen"}, {{true, false}}).size(), 1U);
  EXPECT_THROW((void)fault_choices({"encoder.y melted"}, kBoth), FixtureError);
  EXPECT_THROW((void)fault_choices({"endstop.y_max missing"}, kBoth), FixtureError);  // as built
}

TEST(FaultSpace, HasThePhasesOfTheMotionOnItsMomentsAndEndsOnItsSizes) {
  const auto circle = load_experiment("fixtures/motions/circle-short.toml");
  const auto objective = in_process_objective(circle, {}, 0);
  const auto choices = fault_choices({"encoder.y frozen", "supply sag"}, kBoth);
  const auto phases = objective->phases_of(choices.front());
  ASSERT_GT(phases.size(), 5U);
  EXPECT_EQ(phases.front().from, 0.0);
  for (std::size_t i = 1; i < phases.size(); ++i) {
    EXPECT_EQ(phases[i].from, phases[i - 1].to);
  }
  EXPECT_NEAR(phases.back().to, 1.0, 1e-3);
  // The first: nothing is driven yet.
  EXPECT_LT(phases.front().length() * objective->end_s(), 0.01);
  const FaultSpace space(choices, objective->end_s(), {}, {phases, {}});
  const auto sides = space.sides();
  ASSERT_EQ(sides.size(), space.variables().size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool is_onset = space.variables()[i].name.ends_with("at_s");
    EXPECT_EQ(sides[i].has_ends, !is_onset) << space.variables()[i].name;
    EXPECT_EQ(sides[i].stretches.size(), i == 0 ? phases.size() : 0U);
  }
}

// A margin that is known: the distance of the onset from 3 s, where the fault acts before 8 s.
class KnownObjective final : public Objective {
 public:
  Outcome measure(const SearchCase& one) override {
    ++runs;
    const double at_s = one.faults.front().trigger.value;
    return {.fired =
                at_s<8, .margin = std::fabs(at_s - 3) - 0.05, .broken = at_s> 2.95 && at_s < 3.05};
  }
  double end_s() const override { return 10; }
  std::vector<Stretch> phases_of(const FaultChoice& /*choice*/) const override { return {}; }
  std::size_t runs = 0;
};

FalsifySession session(const std::filesystem::path& file, std::size_t runs) {
  return {{.runs = runs, .runs_a_round = 40, .fingerprint = "f"},
          {{.faults = FaultSpace(fault_choices({"encoder.y frozen"}, kBoth), 10)},
           {.faults = FaultSpace(fault_choices({"supply sag"}, kBoth), 10)}},
          file};
}

TEST(Falsify, ThatWasInterruptedGoesOnWithTheSameTrials) {
  TemporaryFixtures files;
  KnownObjective whole;
  auto at_once = session(files.folder() / "once.jsonl", 200);
  EXPECT_TRUE(at_once.run(
      {&whole}, [] { return true; }, [](const auto&) {}));
  KnownObjective parts;
  auto first = session(files.folder() / "parts.jsonl", 200);
  EXPECT_FALSE(first.run(
      {&parts}, [&] { return parts.runs < 77; }, [](const auto&) {}));
  auto second = session(files.folder() / "parts.jsonl", 200);
  EXPECT_TRUE(second.run(
      {&parts}, [] { return true; }, [](const auto&) {}));
  EXPECT_EQ(parts.runs, whole.runs);
  ASSERT_EQ(second.trials().size(), at_once.trials().size());
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_EQ(second.trials()[i].tried.words(), at_once.trials()[i].tried.words());
    EXPECT_EQ(second.trials()[i].outcome.margin, at_once.trials()[i].outcome.margin);
  }
  EXPECT_EQ(contents_of(files.folder() / "parts.jsonl"),
            contents_of(files.folder() / "once.jsonl"));
}

TEST(Falsify, CountsWhatDidNotFireAsNotTried) {
  TemporaryFixtures files;
  KnownObjective objective;
  auto search = session(files.folder() / "t.jsonl", 400);
  EXPECT_TRUE(search.run(
      {&objective}, [] { return true; }, [](const auto&) {}));
  const auto found = coverage_of(search, 0);
  EXPECT_EQ(found.runs + coverage_of(search, 1).runs, 400U);
  EXPECT_LT(found.fired, found.runs);
  EXPECT_LT(found.uniform, 100U);
  // Onsets behind 8 s were sampled, and acted never.
  EXPECT_LE(found.covered[0], 0.8);
  EXPECT_GT(found.covered[0], 0.6);
  ASSERT_NE(search.worst(), nullptr);
  EXPECT_NEAR(parse_fault(search.worst()->tried.words().front()).trigger.value, 3.0, 0.01);
  EXPECT_TRUE(search.worst()->outcome.broken);
}

// A sag is far from breaking anything, whenever it begins.
class OneIsNear final : public Objective {
 public:
  Outcome measure(const SearchCase& one) override {
    return {.fired = true,
            .margin = one.faults.front().kind == FaultKind::kSag
                          ? 5
                          : std::fabs(one.faults.front().trigger.value - 3)};
  }
  double end_s() const override { return 10; }
  std::vector<Stretch> phases_of(const FaultChoice& /*choice*/) const override { return {}; }
};

TEST(Falsify, SamplesSpacesAlikeAndGivesTheOptimiserTheNearest) {
  TemporaryFixtures files;
  OneIsNear objective;
  std::vector<SearchSpace> spaces;
  for (const char* words :
       {"supply sag", "encoder.y frozen", "supply sag", "supply sag", "supply sag"}) {
    spaces.push_back({.faults = FaultSpace(fault_choices({words}, kBoth), 10)});
  }
  FalsifySession search({.runs = 400, .runs_a_round = 40}, spaces, files.folder() / "t.jsonl");
  EXPECT_TRUE(search.run(
      {&objective}, [] { return true; }, [](const auto&) {}));
  for (std::size_t space = 0; space < spaces.size(); ++space) {
    EXPECT_EQ(coverage_of(search, space).uniform, 32U);  // of 40 samples, 8 at ends
  }
  EXPECT_EQ(coverage_of(search, 1).runs, 40U + 2 * 50U);
}

TEST(Falsify, OfSeveralExperimentsAsksEachForItsOwn) {
  TemporaryFixtures files;
  KnownObjective first;
  OneIsNear second;
  const FaultSpace frozen(fault_choices({"encoder.y frozen"}, kBoth), 10);
  FalsifySession search({.runs = 100, .runs_a_round = 40},
                        {{.experiment = 0, .motion = "a", .faults = frozen},
                         {.experiment = 1, .motion = "b", .faults = frozen}},
                        files.folder() / "t.jsonl");
  EXPECT_TRUE(search.run(
      {&first, &second}, [] { return true; }, [](const auto&) {}));
  EXPECT_EQ(first.runs, coverage_of(search, 0).runs);
  EXPECT_EQ(search.spaces()[1].name(), "b: encoder.y frozen");
  ASSERT_NE(search.worst(), nullptr);
  EXPECT_EQ(search.worst()->space, 0U);  // below 0, where the other is not
}

TEST(Falsify, ComesToEveryFaultBeforeItComesToOneOnASecondExperiment) {
  TemporaryFixtures files;
  OneIsNear objective;
  std::vector<SearchSpace> spaces;
  for (const char* motion : {"a", "b", "c"}) {
    for (const auto& choice : fault_choices({"supply sag", "frozen", "jump"}, kBoth)) {
      spaces.push_back({.motion = motion, .faults = FaultSpace({choice}, 10)});
    }
  }
  ASSERT_EQ(spaces.size(), 15U);
  FalsifySession search({.runs = 15, .runs_a_round = 20, .optimiser = Optimiser::kUniform}, spaces,
                        files.folder() / "t.jsonl");
  EXPECT_TRUE(search.run(
      {&objective}, [] { return true; }, [](const auto&) {}));
  for (std::size_t pass = 0; pass < 3; ++pass) {
    std::set<std::string> faults;
    for (std::size_t i = 5 * pass; i < 5 * pass + 5; ++i) {
      faults.insert(search.spaces()[search.trials()[i].space].faults.name());
    }
    EXPECT_EQ(faults.size(), 5U);
  }
}

TEST(Falsify, ShowsTheNearestOfManySpacesAndKeepsAll) {
  TemporaryFixtures files;
  OneIsNear objective;
  std::vector<SearchSpace> spaces(60,
                                  {.faults = FaultSpace(fault_choices({"supply sag"}, kBoth), 10)});
  spaces[57] = {.motion = "near",
                .faults = FaultSpace(fault_choices({"encoder.y frozen"}, kBoth), 10)};
  FalsifySession search({.runs = 59, .runs_a_round = 2, .optimiser = Optimiser::kUniform}, spaces,
                        files.folder() / "t.jsonl");
  EXPECT_TRUE(search.run(
      {&objective}, [] { return true; }, [](const auto&) {}));
  const auto page = falsify_report(search, {}, "x", nullptr);
  EXPECT_THAT(page, HasSubstr("| --- |\n| near: encoder.y frozen | 1 | 1 | 1 |"));
  EXPECT_THAT(page, HasSubstr("\n19 rows more came no nearer"));
  EXPECT_THAT(page, HasSubstr("and for 1 the runs did not suffice"));
  const auto all = spaces_csv(search);
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 60);
}

TEST(Falsify, BoundsWhatSamplesMayHaveMissed) {
  EXPECT_EQ(rule_of_three(0), 1.0);
  EXPECT_DOUBLE_EQ(rule_of_three(1), 0.95);
  EXPECT_NEAR(rule_of_three(1000), 3.0 / 1000, 1e-5);
}

tests::ProgramOutput falsify(const std::string& arguments) {
  return tests::output_of(tests::quoted(TOWBENCH_PROGRAM) + " falsify " + arguments);
}

TEST(FalsifyVerb, RefusesInOneLine) {
  for (const char* arguments :
       {"kill-1khz --budget 0", "kill-1khz --budget \"3 weeks\"", "kill-1khz --faults melted",
        "kill-1khz --requirement NO-1", "no-such-experiment", "kill-1khz --optimiser guess",
        "kill-1khz --controller external:/tmp/x", "kill-1khz --faults none",
        "kill-1khz --faults none --machine 0.1 --requirement rules", "pulses --speed 0.5 1",
        "circle --speed 2 1", "circle --snapshots 3 --start 0.01",
        "circle --snapshots 3 --workers 2", "circle --shard 3/2",
        "kill-1khz --faults frozen --except encoder.y,encoder.x", "kill-1khz --except melted",
        "kill-1khz one-axis --faults frozen --except frozen",
        "kill-1khz trapezoid-400 --requirement KILL",
        "fixtures/any-controller/circle.toml --typed stop --controller process:true"}) {
    const auto output = falsify(arguments);
    EXPECT_EQ(output.code, kExitBadInput) << arguments << output.text;
    EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
  }
}

// Parts side by side, one after the other, or begun and taken up: the same trials.
TEST(FalsifyVerb, PutsItsPartsTogether) {
  TemporaryFixtures files;
  const auto out = files.folder().string();
  const std::string search =
      "fixtures/motions/goto-both.toml fixtures/motions/trapezoid-x.toml --requirement rules "
      "--faults \"encoder.x frozen\" --budget \"21 runs\" -q --out " +
      out;
  const auto first = falsify(search + "/a --shard 2/2");
  EXPECT_EQ(first.code, kExitRuntime) << first.text;
  EXPECT_THAT(first.text, HasSubstr("other parts are not complete"));
  const auto together = falsify(search + "/a --workers 2");
  const auto at_once = falsify(search + "/b --workers 2");
  EXPECT_EQ(together.code, at_once.code);
  for (const char* name : {"/trials-1-of-2.jsonl", "/trials-2-of-2.jsonl", "/falsify.md"}) {
    EXPECT_EQ(contents_of(out + "/a" + name), contents_of(out + "/b" + name)) << name;
  }
  const auto page = contents_of(out + "/b/falsify.md");
  EXPECT_THAT(page, HasSubstr("goto-both: encoder.x frozen"));
  EXPECT_THAT(page, HasSubstr("Worst case of 2 experiments"));
}

TEST(FalsifyVerb, LeavesTheWorstRunAReportAndTheExperiment) {
  TemporaryFixtures files;
  const auto out = files.folder().string();
  const auto output =
      falsify("kill-1khz --faults \"encoder.y frozen\" --budget \"12 runs\" --out " + out +
              "/f --keep " + out + "/worst.toml");
  EXPECT_LE(output.code, kExitFail) << output.text;
  EXPECT_THAT(output.text, HasSubstr("encoder.y frozen"));
  EXPECT_THAT(output.text, HasSubstr("rule of three"));
  const auto kept = load_experiment(out + "/worst.toml");
  EXPECT_EQ(kept.experiment.faults.size(), 1U);
  Runs runs;
  EXPECT_EQ(runs.run(kept).exit_code, output.code);
}

}  // namespace
}  // namespace towbench::harness
