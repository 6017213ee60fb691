// How a board's faults and budgets are written: as tables of an experiment file, and faults as
// words of the command line.
#pragma once

#include <string>
#include <string_view>

#include "harness/experiment/board_plan.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/fixtures/table_reader.h"

namespace towbench::harness {

// One [[board_fault]] or [[board_budget]]. Throw FixtureError.
[[nodiscard]] BoardFault read_board_fault(TableReader& reader);
[[nodiscard]] BoardBudget read_board_budget(TableReader& reader);

[[nodiscard]] std::string to_toml(const BoardFault& fault);
[[nodiscard]] std::string to_toml(const BoardBudget& budget);

// Whether --fault speaks of the board: "board KIND key=value ...".
[[nodiscard]] bool is_board_fault(std::string_view words) noexcept;
// Throws FixtureError.
[[nodiscard]] BoardFault parse_board_fault(std::string_view words);

// Adds a fault that the experiment's file does not hold, and notes it in its text. Its budgets,
// which speak of the sound board, do not apply any more.
void add_board_fault(ExperimentFixture& fixture, const BoardFault& fault);

// Behind the faults of the command line, in the experiment that the run folder keeps: what they do
// to the budgets is not judged when it is run again either.
inline constexpr const char* kBudgetsDoNotApply = "budgets_apply = false\n";

}  // namespace towbench::harness
