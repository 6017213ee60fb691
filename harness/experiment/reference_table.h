// A reference that a file states: times and positions, and between them a curve that passes through
// each of them and turns nowhere else.
//
//   time_s,position_m      from 0,0 on, where the axis stands when the motion begins; times rise
//   0,0
//   0.01,0.0002
//
// Between two rows the position is a cubic whose slopes at the rows are those of PCHIP (Fritsch and
// Carlson 1980), so that it stays between them: what holds for the rows holds for the curve. It
// begins and ends at rest.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "harness/experiment/reference.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/fixtures/fixture_file.h"

namespace towbench::harness {

class ReferenceTable {
 public:
  // `path` is named in what is refused. Throws FixtureError.
  [[nodiscard]] static std::shared_ptr<const ReferenceTable> parse(
      std::string_view text, const std::filesystem::path& path);
  // Reads it and adds it to `sources`. `named_at`: where an experiment names it.
  [[nodiscard]] static std::shared_ptr<const ReferenceTable> load(
      const std::filesystem::path& path, const FixtureError::Place& named_at, SourceFiles& sources);

  // Throws FixtureError, with the row, unless every position lies in between.
  void require_within(double min_m, double max_m) const;
  [[nodiscard]] double duration_s() const noexcept { return rows_.back().time_s; }
  // `time_s` from 0 to the duration.
  [[nodiscard]] ReferencePoint at(double time_s) const noexcept;

 private:
  struct Row {
    double time_s = 0;
    double position_m = 0;
    double slope_m_per_s = 0;
  };

  [[nodiscard]] FixtureError wrong(std::size_t row, const char* column, double given,
                                   std::string allowed) const;
  void check() const;

  std::filesystem::path path_;
  std::vector<Row> rows_;
};

}  // namespace towbench::harness
