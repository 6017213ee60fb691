// What the options of several verbs may be. A value beyond it is a bad argument (exit code 2).
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

namespace towbench::harness {

// CLI11 takes "-1" for an unsigned number.
[[nodiscard]] inline CLI::Validator whole_number() {
  return CLI::Validator(
      [](const std::string& text) {
        std::uint64_t value = 0;
        const auto* const end = text.data() + text.size();
        const auto read = std::from_chars(text.data(), end, value);
        return read.ec == std::errc() && read.ptr == end ? std::string()
                                                         : '"' + text + "\" is no whole number";
      },
      "");
}

// Neither negative nor "nan" or "inf"; at most a year.
[[nodiscard]] inline CLI::Validator seconds_given() {
  return CLI::Validator(
      [](const std::string& text) {
        constexpr double kYear_s = 3.2e7;
        double value = 0;
        const auto* const end = text.data() + text.size();
        const auto read = std::from_chars(text.data(), end, value);
        const bool good = read.ec == std::errc() && read.ptr == end && std::isfinite(value) &&
                          value >= 0 && value <= kYear_s;
        return good ? std::string() : '"' + text + "\" is no time from 0 to 3.2e7 s";
      },
      "");
}

// A folder that is there or can be made.
[[nodiscard]] inline CLI::Validator folder_to_write() {
  return CLI::Validator(
      [](const std::string& text) {
        std::error_code error;
        std::filesystem::path path(text);
        while (!path.empty() && !std::filesystem::exists(path, error) && !error &&
               path.has_parent_path() && path != path.parent_path()) {
          path = path.parent_path();
        }
        const bool good =
            !text.empty() && !error &&
            (!std::filesystem::exists(path, error) || std::filesystem::is_directory(path, error)) &&
            !error;
        return good ? std::string() : '"' + text + "\" is no folder";
      },
      "");
}

}  // namespace towbench::harness
