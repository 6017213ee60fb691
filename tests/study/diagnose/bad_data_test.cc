// Data that no diagnosis should be made from gets a name, not a number.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/diagnose/position_jump.h"
#include "study/diagnose/run_reader.h"
#include "study/logs/read_table.h"
#include "tests/harness/fixtures/temporary_fixtures.h"
#include "tests/study/diagnose/hidden_case.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;

bool has(const logs::Findings& findings, const std::string& name) {
  for (const logs::Finding& finding : findings) {
    if (finding.name == name) {
      return true;
    }
  }
  return false;
}

logs::Table good_table(std::size_t rows = 2000) {
  logs::Table table;
  table.names = {"t", "q", "u"};
  table.columns.resize(3);
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = 1e-3 * static_cast<double>(i);
    table.columns[0].push_back(t);
    table.columns[1].push_back(0.1 * std::sin(t));
    table.columns[2].push_back(std::cos(t));
    table.line.push_back(static_cast<std::uint32_t>(i + 2));
  }
  return table;
}

logs::ColumnMap map_of_table() {
  logs::ColumnMap map;
  map.time = "t";
  map.position = "q";
  map.input = "u";
  return map;
}

logs::Findings findings_of(const logs::Table& table) {
  logs::Findings findings;
  (void)make_run(table, map_of_table(), "log", findings);
  return findings;
}

TEST(BadData, AGoodTableRaisesNothing) {
  EXPECT_TRUE(findings_of(good_table()).empty());
}

TEST(BadData, ConstantColumnsAreNamed) {
  logs::Table table = good_table();
  std::fill(table.columns[1].begin(), table.columns[1].end(), 0.3);
  EXPECT_TRUE(has(findings_of(table), "constant_position"));
  table = good_table();
  std::fill(table.columns[2].begin(), table.columns[2].end(), 0.0);
  EXPECT_TRUE(has(findings_of(table), "constant_input"));
}

TEST(BadData, NotANumberIsLeftOutAndTold) {
  logs::Table table = good_table();
  table.columns[1][77] = std::numeric_limits<double>::quiet_NaN();
  const logs::Findings findings = findings_of(table);
  EXPECT_TRUE(has(findings, "not_a_number"));
  EXPECT_TRUE(has(findings, "missing_samples"));
  EXPECT_FALSE(is_fatal(findings));
}

TEST(BadData, TimeThatRunsBackIsRefused) {
  logs::Table table = good_table();
  table.columns[0][500] = 0.1;
  EXPECT_TRUE(has(findings_of(table), "time_not_rising"));
}

TEST(BadData, JitteredTimeStampsAreResampledAndTold) {
  logs::Table table = good_table();
  for (std::size_t i = 1; i + 1 < table.rows(); i += 2) {
    table.columns[0][i] += 0.2e-3;
  }
  logs::Findings findings;
  const auto run = make_run(table, map_of_table(), "log", findings);
  EXPECT_TRUE(has(findings, "jittered_time"));
  EXPECT_FALSE(is_fatal(findings));
  const double t = 1000 * run.period_s;
  EXPECT_NEAR(run.position_m[1000], 0.1 * std::sin(t), 3e-5);
}

TEST(BadData, ARunStartsWhereItsClockSays) {
  logs::Table table = good_table();
  for (double& time : table.columns[0]) time = 1e3 * (time + 40);
  logs::ColumnMap map = map_of_table();
  map.time_scale_s = 1e-3;
  logs::Findings findings;
  const auto run = make_run(table, map, "log", findings);
  EXPECT_DOUBLE_EQ(run.start_s, 40);
  EXPECT_NEAR(run.period_s, 1e-3, 1e-12);
}

TEST(BadData, ALogTooShortIsRefused) {
  EXPECT_TRUE(has(findings_of(good_table(50)), "too_short"));
}

TEST(BadData, AnEmptyFileIsRefused) {
  const harness::TemporaryFixtures folder;
  logs::Findings findings;
  (void)logs::read_table(folder.write("empty.csv", ""), findings);
  EXPECT_TRUE(has(findings, "file_unreadable"));
}

Diagnosis with_input(double scale, Eigen::Index shift) {
  const HiddenAxis axis;
  Request request;
  request.model = nominal_of(axis);
  Run run = run_of(axis, make_hidden_log(axis, 1));
  run.input_N *= scale;
  run.input_step_N = 0;
  if (shift > 0) {
    const Eigen::Index n = run.size();
    run.input_N.tail(n - shift) = run.input_N.head(n - shift).eval();
  }
  request.runs = {run};
  return study::diagnose::diagnose(request);
}

// A bench's log begins before its counter is preset.
TEST(BadData, AJumpOfThePositionIsJoinedAndTold) {
  const HiddenAxis axis;
  const auto clean = run_of(axis, make_hidden_log(axis, 1));
  auto jumping = clean;
  jumping.position_m.head(3).array() -= 0.449;
  logs::Findings findings;
  join_position_jumps(jumping, findings);
  EXPECT_TRUE(has(findings, "position_jump"));
  EXPECT_EQ(jumping.missing[3], 1);
  EXPECT_LT((jumping.position_m - clean.position_m).cwiseAbs().maxCoeff(), 1e-3);
  logs::Findings none;
  auto untouched = clean;
  join_position_jumps(untouched, none);
  EXPECT_TRUE(none.empty());
}

TEST(BadData, AReversedCommandIsNamed) {
  EXPECT_TRUE(has(with_input(-1, 0).findings, "command_sign_reversed"));
}

TEST(BadData, AUnitWrongByAThousandIsNamed) {
  EXPECT_TRUE(has(with_input(1000, 0).findings, "input_unit_off"));
  EXPECT_TRUE(has(with_input(1e-3, 0).findings, "input_unit_off"));
}

TEST(BadData, ShiftedColumnsAreNamed) {
  EXPECT_TRUE(has(with_input(1, 80).findings, "columns_shifted"));
}

}  // namespace
}  // namespace towbench::tests
