#include "study/logs/mat_columns.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>

#include <matio.h>

#include "study/logs/table.h"

namespace towbench::study::logs {
namespace {

constexpr std::size_t kMostSeriesOfAMatrix = 64;
constexpr std::size_t kMostCells = 100'000'000;
constexpr int kDeepestField = 4;

using MatFile = std::unique_ptr<mat_t, decltype([](mat_t* file) { Mat_Close(file); })>;
using Variable = std::unique_ptr<matvar_t, decltype([](matvar_t* v) { Mat_VarFree(v); })>;

template <typename Number>
std::vector<double> numbers(const matvar_t& variable, std::size_t count) {
  const std::span<const Number> data(static_cast<const Number*>(variable.data), count);
  return {data.begin(), data.end()};
}

// Empty when the variable holds no plain numbers, or fewer than it says.
std::vector<double> values_of(const matvar_t& variable, std::size_t count) {
  if (variable.data == nullptr || variable.isComplex != 0 || variable.data_size <= 0 ||
      variable.nbytes / static_cast<std::size_t>(variable.data_size) < count) {
    return {};
  }
  switch (variable.data_type) {
    case MAT_T_DOUBLE:
      return numbers<double>(variable, count);
    case MAT_T_SINGLE:
      return numbers<float>(variable, count);
    case MAT_T_INT8:
      return numbers<std::int8_t>(variable, count);
    case MAT_T_UINT8:
      return numbers<std::uint8_t>(variable, count);
    case MAT_T_INT16:
      return numbers<std::int16_t>(variable, count);
    case MAT_T_UINT16:
      return numbers<std::uint16_t>(variable, count);
    case MAT_T_INT32:
      return numbers<std::int32_t>(variable, count);
    case MAT_T_UINT32:
      return numbers<std::uint32_t>(variable, count);
    case MAT_T_INT64:
      return numbers<std::int64_t>(variable, count);
    case MAT_T_UINT64:
      return numbers<std::uint64_t>(variable, count);
    default:
      return {};
  }
}

class MatCollector {
 public:
  explicit MatCollector(std::vector<MatColumn>& columns) : columns_(columns) {}

  // `variable` with its data; structures are followed.
  void add(matvar_t& variable, const std::string& name, int depth) {
    if (variable.rank != 2 || variable.dims == nullptr) {
      leave_out(name, "has more than two dimensions");
    } else if (variable.class_type == MAT_C_STRUCT) {
      add_fields(variable, name, depth);
    } else if (variable.class_type < MAT_C_DOUBLE || variable.class_type > MAT_C_UINT64) {
      leave_out(name, "holds no numbers");
    } else {
      add_matrix(variable, name);
    }
  }

  void leave_out(std::string name, const char* reason) {
    columns_.push_back({std::move(name), reason, {}});
  }

 private:
  void add_fields(matvar_t& variable, const std::string& name, int depth) {
    if (depth >= kDeepestField || variable.dims[0] != 1 || variable.dims[1] != 1) {
      return leave_out(name, "is an array of structures, or nested too deep");
    }
    char* const* names = Mat_VarGetStructFieldnames(&variable);
    const unsigned count = names == nullptr ? 0 : Mat_VarGetNumberOfFields(&variable);
    for (unsigned i = 0; i < count; ++i) {
      auto* field = Mat_VarGetStructFieldByIndex(&variable, i, 0);
      if (field != nullptr && names[i] != nullptr) {
        add(*field, name + "." + names[i], depth + 1);
      }
    }
  }

  void add_matrix(const matvar_t& variable, const std::string& name) {
    const std::size_t rows = variable.dims[0];
    const std::size_t across = variable.dims[1];
    const std::size_t series = std::min(rows, across);
    const std::size_t length = std::max(rows, across);
    if (length < 2 || series == 0) {
      return leave_out(name, "is a single number, or empty");
    }
    if (length > kMostRows || series > kMostSeriesOfAMatrix) {
      return leave_out(name, "is too large for series of numbers");
    }
    const auto all = values_of(variable, rows * across);
    if (all.empty()) {
      return leave_out(name, "holds no real numbers, or fewer than it says");
    }
    const bool upright = rows >= across;
    for (std::size_t s = 0; s < series; ++s) {
      MatColumn column{series == 1 ? name : name + "_" + std::to_string(s + 1), "", {}};
      column.values.reserve(length);
      for (std::size_t i = 0; i < length; ++i) {  // MATLAB stores column by column
        column.values.push_back(all[upright ? s * rows + i : i * rows + s]);
      }
      columns_.push_back(std::move(column));
    }
  }

  std::vector<MatColumn>& columns_;
};

std::size_t cells_of(const matvar_t& variable) {
  std::size_t cells = 1;
  for (int i = 0; i < variable.rank && variable.dims != nullptr; ++i) {
    if (variable.dims[i] > kMostCells || (cells *= variable.dims[i]) > kMostCells) {
      return kMostCells + 1;
    }
  }
  return cells;
}

}  // namespace

bool read_mat_columns(const char* path, std::vector<MatColumn>& columns) {
  Mat_LogInitFunc("towbench", [](int, char*) {});
  const MatFile file(Mat_Open(path, MAT_ACC_RDONLY));
  if (file == nullptr) {
    return false;
  }
  MatCollector collector(columns);
  while (columns.size() <= kMostColumns) {
    const Variable variable(Mat_VarReadNextInfo(file.get()));
    if (variable == nullptr) {
      break;
    }
    const std::string name = variable->name == nullptr ? "" : variable->name;
    if (name.empty() || cells_of(*variable) > kMostCells) {
      collector.leave_out(name, "is too large for series of numbers");
    } else if (Mat_VarReadDataAll(file.get(), variable.get()) != 0) {
      collector.leave_out(name, "cannot be read");
    } else {
      collector.add(*variable, name, 0);
    }
  }
  return true;
}

}  // namespace towbench::study::logs
