// Uniform time for samples that came at nearly uniform times, with gaps.
//
// Jittered stamps are ambiguous: the samples were taken when they say, or evenly and only the
// stamps are late. The position tells: a moving body read at other times than stated is rougher.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "study/diagnose/log_columns.h"
#include "study/logs/finding.h"

namespace towbench::study::diagnose {

class TimeGrid {
 public:
  // Named findings: time_not_rising, sampling_changes, sampling_rate_off, missing_samples,
  // jittered_time. After a fatal one the grid is unusable.
  TimeGrid(const logs::Table& table, const LogColumns& columns, double time_scale_s,
           const std::string& file, logs::Findings& findings);

  [[nodiscard]] double period_s() const noexcept { return period_s_; }
  [[nodiscard]] double start_s() const noexcept { return time_s_.front(); }
  // 1 where a sample lies in a gap too long to be bridged.
  [[nodiscard]] const std::vector<char>& missing() const noexcept { return missing_; }
  // Values of a column on the grid: linear between its samples, itself where those are uniform.
  [[nodiscard]] Eigen::VectorXd resampled(const std::vector<double>& column, double scale) const;

 private:
  void tell(logs::Finding::Kind kind, const char* name, std::string sentence);
  [[nodiscard]] bool rises(const logs::Table& table);
  [[nodiscard]] bool is_steady();
  void choose_times(const std::vector<double>& position);
  void find_gaps();
  [[nodiscard]] std::vector<double> evened() const;
  [[nodiscard]] double jitter_share() const;

  const std::vector<std::size_t>& rows_;
  const std::string& file_;
  logs::Findings& findings_;
  std::vector<double> time_s_;  // of the rows
  double period_s_ = 0;
  Eigen::Index samples_ = 0;
  bool uniform_ = false;  // but for rounding: no interpolation, so counts stay counts
  std::vector<char> missing_;
};

}  // namespace towbench::study::diagnose
