// "local:PATH" on the command line: a socket of this host, private to the user.
#pragma once

#include <filesystem>
#include <string>

#include "harness/fixtures/fixture_error.h"

namespace towbench::harness {

// Throws FixtureError for any other carrier: nothing listens beyond this host unless named.
[[nodiscard]] inline std::filesystem::path local_path(const std::string& option,
                                                      const std::string& address) {
  constexpr std::string_view kScheme = "local:";
  if (!address.starts_with(kScheme) || address.size() == kScheme.size()) {
    throw FixtureError({"command line", 0, option}, '"' + address + '"',
                       "local:PATH, a socket of this host");
  }
  return address.substr(kScheme.size());
}

}  // namespace towbench::harness
