// A table as a reference: the curve through its rows, and what is refused of a file.
#include "harness/experiment/reference_table.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "harness/experiment/experiment_fixture.h"
#include "harness/experiment/experiment_toml.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/record/temporary_folder.h"

namespace towbench::harness {
namespace {

using std::numbers::pi;

std::string table_of(double step_s, double end_s, const std::function<double(double)>& position_m) {
  std::string text = "time_s,position_m\n";
  for (int i = 0; i * step_s <= end_s + 1e-9; ++i) {
    text += fmt::format("{},{}\n", i * step_s, position_m(i * step_s));
  }
  return text;
}

double slow_sine(double time_s) {
  return 0.2 * (1 - std::cos(pi * time_s));
}

// Place and what is allowed, or that it was taken.
std::string table_refusal(const std::string& text) {
  try {
    (void)ReferenceTable::parse(text, "way.csv");
  } catch (const FixtureError& error) {
    return error.what();
  }
  return "taken";
}

TEST(ReferenceTable, FollowsAKnownMotionWithBothDerivatives) {
  const auto table = ReferenceTable::parse(table_of(0.001, 2, slow_sine), "way.csv");
  EXPECT_DOUBLE_EQ(table->duration_s(), 2);
  for (double t = 0.01; t < 1.99; t += 0.00137) {
    const auto at = table->at(t);
    EXPECT_NEAR(at.position_m, slow_sine(t), 1e-7) << t;
    EXPECT_NEAR(at.velocity_m_per_s, 0.2 * pi * std::sin(pi * t), 2e-3) << t;
  }
  EXPECT_NEAR(table->at(0.5).acceleration_m_per_s2, 0, 0.1);
  EXPECT_NEAR(table->at(0.2505).acceleration_m_per_s2, 0.2 * pi * pi * std::cos(pi * 0.2505), 0.1);
}

TEST(ReferenceTable, VelocityAndAccelerationAreTheDerivatives) {
  constexpr double kStep_s = 1e-6;
  const auto table = ReferenceTable::parse(
      "time_s,position_m\n0,0\n0.5,0.1\n0.8,0.1\n1.5,0.3\n1.6,-0.1\n", "way.csv");
  for (double t = 0.0131; t < 1.59; t += 0.0271) {
    const auto before = table->at(t - kStep_s);
    const auto at = table->at(t);
    const auto after = table->at(t + kStep_s);
    EXPECT_NEAR((after.position_m - before.position_m) / (2 * kStep_s), at.velocity_m_per_s, 1e-6);
    EXPECT_NEAR((after.velocity_m_per_s - before.velocity_m_per_s) / (2 * kStep_s),
                at.acceleration_m_per_s2, 1e-3);
  }
}

TEST(ReferenceTable, PassesThroughItsRowsAndStaysBetweenThem) {
  const std::vector<std::pair<double, double>> rows{
      {0, 0}, {0.5, 0.1}, {0.8, 0.1}, {1.5, 0.3}, {1.6, -0.1}};
  const auto table = ReferenceTable::parse(
      "time_s,position_m\n0,0\n0.5,0.1\n0.8,0.1\n1.5,0.3\n1.6,-0.1\n", "way.csv");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(table->at(rows[i].first).position_m, rows[i].second, 1e-15);
    for (double s = 0; i > 0 && s <= 1; s += 0.01) {
      const auto [low, high] = std::minmax(rows[i - 1].second, rows[i].second);
      const double t = rows[i - 1].first + s * (rows[i].first - rows[i - 1].first);
      EXPECT_GE(table->at(t).position_m, low - 1e-12) << t;
      EXPECT_LE(table->at(t).position_m, high + 1e-12) << t;
    }
  }
}

TEST(ReferenceTable, AStraightWayIsStraight) {
  const auto table = ReferenceTable::parse(table_of(0.1, 1, [](double t) { return 0.3 * t; }), "w");
  for (const double t : {0.0, 1.0}) {
    EXPECT_EQ(table->at(t).velocity_m_per_s, 0) << "it begins and ends in a hold";
  }
  for (double t = 0.1; t <= 0.9; t += 0.0173) {
    EXPECT_NEAR(table->at(t).position_m, 0.3 * t, 1e-12);
    EXPECT_NEAR(table->at(t).velocity_m_per_s, 0.3, 1e-9);
    EXPECT_NEAR(table->at(t).acceleration_m_per_s2, 0, 1e-7);
  }
}

TEST(ReferenceTable, TakesLinesOfOtherSystemsAndALastOneWithoutEnd) {
  EXPECT_EQ(table_refusal("time_s,position_m\r\n0,0\r\n1,0.1\r\n2,0.1\r\n3,0.2"), "taken");
  EXPECT_EQ(table_refusal("position_m,time_s\n0,0\n0.1,1\n0.1,2\n0.2,3\n"), "taken");
}

TEST(ReferenceTable, EachKindOfBadFileIsRefusedWithItsLine) {
  const std::string head = "time_s,position_m\n0,0\n1,0.1\n";
  const struct {
    const char* what;
    std::string text;
    const char* place;
    const char* words;
  } cases[] = {
      {"nothing", "", "way.csv", "no header"},
      {"a header alone", "time_s,position_m\n", "way.csv", "0 rows"},
      {"three rows", head + "2,0.2\n", "way.csv", "3 rows"},
      {"another header", "t,x\n0,0\n1,0\n2,0\n3,1\n", "way.csv:1", "time_s,position_m"},
      {"a column too many", "time_s,position_m,z\n0,0,0\n", "way.csv:1", "time_s,position_m"},
      {"a column twice", "time_s,time_s\n0,0\n", "way.csv", "twice"},
      {"a word", head + "2,far\n3,1\n", "way.csv:4", "column position_m: 'far' is not a number"},
      {"a field too few", head + "2\n3,1\n", "way.csv:4", "and the header names 2 columns"},
      {"an empty line", head + "\n3,1\n4,1\n", "way.csv:4", "and the header names 2 columns"},
      {"NaN as a position", head + "2,nan\n3,1\n", "way.csv:4: position_m", "nan"},
      {"infinity as a position", head + "2,inf\n3,1\n", "way.csv:4: position_m", "inf"},
      {"NaN as a time", head + "nan,0.1\n3,1\n", "way.csv:4: time_s", "nan"},
      {"infinity as a time", head + "2,0.1\ninf,0.1\n", "way.csv:5: time_s", "inf"},
      {"a time twice", head + "1,0.1\n3,1\n", "way.csv:4: time_s", "behind 1"},
      {"times that run back", head + "2,0.1\n1.5,0.2\n", "way.csv:5: time_s", "behind 2"},
      {"more than a day", head + "2,0.1\n1e9,0.2\n", "way.csv:5: time_s", "86400"},
      {"a jump", head + "2,0.1\n2.00001,0.2\n", "way.csv:5: position_m", "1e+04 m/s"},
      {"far beyond any tank", head + "2,1e7\n3,0\n", "way.csv:4: position_m", "1000"},
      {"a late beginning", "time_s,position_m\n1,0\n2,0\n3,0\n4,1\n", "way.csv:2", "0,0"},
      {"a place of its own", "time_s,position_m\n0,2\n2,2\n3,2\n4,1\n", "way.csv:2", "0,0"},
  };
  for (const auto& each : cases) {
    const auto refusal = table_refusal(each.text);
    EXPECT_NE(refusal.find(each.place), std::string::npos) << each.what << ": " << refusal;
    EXPECT_NE(refusal.find(each.words), std::string::npos) << each.what << ": " << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos) << each.what;
  }
}

// ---- in an experiment ----

class TableInExperiment : public ::testing::Test {
 protected:
  TableInExperiment() {
    for (const char* part : {"rigs", "plants"}) {
      std::filesystem::copy(fixtures_directory() / part, folder_.path() / part);
    }
  }
  void write(const char* name, const std::string& text) {
    std::ofstream(folder_.path() / name) << text;
  }
  ExperimentFixture load(const std::string& more = "") {
    write("tow.toml",
          "schema = 1\nname = \"tow\"\nrig = \"rigs/macs-nominal.toml\"\n"
          "duration_limit_s = 20.0\n"
          "[[reference]]\nmove = \"table\"\naxis = \"y\"\nat_s = 1.0\nfile = \"way.csv\"\n" +
              more + "[[budget]]\nmetric = \"y_carriage_travel_m\"\nmin = 0.1\n");
    return load_experiment(folder_.path() / "tow.toml");
  }
  std::string refusal(const std::string& more = "") {
    try {
      (void)load(more);
    } catch (const FixtureError& error) {
      return error.what();
    }
    return "taken";
  }
  TemporaryFolder folder_;
};

TEST_F(TableInExperiment, IsReadKeptAndWrittenBack) {
  const auto text = table_of(0.01, 1, slow_sine);
  write("way.csv", text);
  const auto fixture = load();
  const ReferenceSchedule schedule(fixture.experiment.reference);
  EXPECT_EQ(schedule.end_ns(), core::nanoseconds(2.0));
  EXPECT_NEAR(schedule.at(core::Axis::kY, core::nanoseconds(1.5)).position_m, slow_sine(0.5), 1e-6);
  ASSERT_EQ(fixture.sources.back().path.filename(), "way.csv");
  EXPECT_EQ(fixture.sources.back().text, text);
  EXPECT_NE(to_toml(fixture).find("file = \"way.csv\""), std::string::npos);
}

TEST_F(TableInExperiment, IsRefusedWhereItIsNotThereOverlapsOrLeavesTheMachine) {
  EXPECT_NE(refusal().find("reference[0].file"), std::string::npos) << refusal();
  write("way.csv", table_of(0.01, 2, slow_sine));
  EXPECT_EQ(refusal(), "taken");
  const auto overlap = refusal(
      "[[reference]]\nmove = \"step\"\naxis = \"y\"\nat_s = 2.5\n"
      "distance_m = 0.1\n");
  EXPECT_NE(overlap.find("a time from 3.0 on"), std::string::npos) << overlap;
  write("way.csv", table_of(0.1, 20, [](double t) { return 0.5 * t; }));
  EXPECT_NE(refusal().find("between the hard ends"), std::string::npos) << refusal();
  std::filesystem::remove(folder_.path() / "way.csv");
  std::filesystem::create_directory(folder_.path() / "way.csv");
  EXPECT_NE(refusal().find("CSV file"), std::string::npos) << refusal();
}

}  // namespace
}  // namespace towbench::harness
