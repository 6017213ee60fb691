// The real vectors of a MATLAB file, each as it stands.
//
// A vector is a column by its variable's name; a matrix gives one column for each row or column,
// whichever are fewer, as name_1, name_2; a field of a scalar structure is variable.field.
#pragma once

#include <string>
#include <vector>

namespace towbench::study::logs {

struct MatColumn {
  std::string name;
  std::string left_out;  // why, when it holds no numbers of use; then values is empty
  std::vector<double> values;
};

// Reads with matio (MAT 4, 5 and 7.3). A damaged file may end the process: read_mat_apart() keeps
// that from the caller. False when matio does not take the file.
[[nodiscard]] bool read_mat_columns(const char* path, std::vector<MatColumn>& columns);

}  // namespace towbench::study::logs
