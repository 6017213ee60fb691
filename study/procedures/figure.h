// What a procedure shows of itself: tables and plots, as data. How they look is the report's.
#pragma once

#include <string>
#include <vector>

namespace towbench::study::procedures {

enum class Mark { kLine, kDots };

struct Curve {
  std::string name;
  std::vector<double> x{};
  std::vector<double> y{};  // as many; NaN breaks a line
  Mark mark = Mark::kLine;
  std::vector<double> low{};  // of an interval, empty or as many
  std::vector<double> high{};
};

struct Figure {
  std::string title;
  std::string x_label;  // with its unit
  std::string y_label;
  std::vector<Curve> curves{};
  std::string caption{};  // what the thesis shows beside it, if anything
};

struct ResultTable {
  std::string title;
  std::vector<std::string> head{};
  std::vector<std::vector<std::string>> rows{};
};

}  // namespace towbench::study::procedures
