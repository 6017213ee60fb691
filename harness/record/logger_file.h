// What a data logger slower than the controller keeps of a run: logger.csv, the rows of log.csv
// that it sees.
#pragma once

#include <filesystem>

namespace towbench::harness {

// The first row of log.csv at or behind each multiple of 1 / rate_Hz, byte for byte, under the same
// header. Times of rows are whole exchanges, so that a logger of 150 Hz beside a controller of 1
// kHz keeps every 6th or 7th. Nothing without log.csv, or at a rate of 0.
void write_logger_file(const std::filesystem::path& folder, double rate_Hz);

}  // namespace towbench::harness
