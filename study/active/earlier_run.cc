#include "study/active/earlier_run.h"

#include <fstream>

#include <nlohmann/json.hpp>

#include "harness/fixtures/canonical_hash.h"

namespace towbench::study::active {

std::optional<std::filesystem::path> earlier_run(const std::filesystem::path& runs,
                                                 const harness::ExperimentFixture& fixture,
                                                 std::uint64_t seed) {
  const nlohmann::json hashes{{"rig", harness::hash_text(fixture.rig.hash)},
                              {"controller", harness::hash_text(fixture.controller.hash)},
                              {"experiment", harness::hash_text(fixture.hash)}};
  std::error_code none_yet;
  for (const auto& entry : std::filesystem::directory_iterator(runs, none_yet)) {
    std::ifstream stream(entry.path() / "result.json");
    const auto result = nlohmann::json::parse(stream, nullptr, false);
    if (result.is_object() && result.value("status", "") == "complete" &&
        result.value("verdict", "") == "PASS" && result.value("seed", std::uint64_t{0}) == seed &&
        result.value("hashes", nlohmann::json{}) == hashes) {
      return entry.path();
    }
  }
  return std::nullopt;
}

}  // namespace towbench::study::active
