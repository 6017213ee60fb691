#include "harness/record/logger_file.h"

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include "harness/record/line_writer.h"

namespace towbench::harness {

void write_logger_file(const std::filesystem::path& folder, double rate_Hz) {
  std::ifstream log(folder / "log.csv");
  std::string line;
  if (rate_Hz <= 0 || !std::getline(log, line)) {
    return;
  }
  constexpr double kSameMoment_s = 1e-9;  // far below an exchange, far above rounding
  std::string kept = line + '\n';
  std::int64_t seen = 0;
  while (std::getline(log, line)) {
    const double time_s = std::strtod(line.c_str(), nullptr);
    if (time_s + kSameMoment_s >= static_cast<double>(seen) / rate_Hz) {
      kept += line + '\n';
      seen = static_cast<std::int64_t>((time_s + kSameMoment_s) * rate_Hz) + 1;
    }
  }
  write_atomically(folder / "logger.csv", kept);
}

}  // namespace towbench::harness
