#include "study/procedures/kept_outcome.h"

#include <array>
#include <cstdint>
#include <fstream>

#include <fmt/format.h>

#include "harness/record/line_writer.h"

namespace towbench::study::procedures {

std::string file_fingerprint(const std::filesystem::path& path) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  if (std::ifstream file(path, std::ios::binary); !path.empty() && file) {
    std::array<char, 65536> block{};
    while (file.read(block.data(), block.size()) || file.gcount() > 0) {
      for (std::streamsize i = 0; i < file.gcount(); ++i) {
        hash = (hash ^ static_cast<unsigned char>(block.at(static_cast<std::size_t>(i)))) *
               0x100000001b3U;
      }
    }
  }
  return fmt::format("{:016x}", hash);
}

const std::string& program_fingerprint() {
  static const std::string kProgram = file_fingerprint("/proc/self/exe");
  return kProgram;
}

std::optional<nlohmann::json> kept_outcome(const std::filesystem::path& path,
                                           const std::string& fingerprint) {
  std::ifstream stream(path);
  if (!stream) {
    return std::nullopt;
  }
  try {
    auto json = nlohmann::json::parse(stream);
    if (json.at("fingerprint") != fingerprint) {
      return std::nullopt;
    }
    return json.at("outcome");
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // torn or foreign: run again
  }
}

void keep_outcome(const std::filesystem::path& path, const std::string& fingerprint,
                  const nlohmann::json& outcome) {
  std::filesystem::create_directories(path.parent_path());
  harness::write_atomically(
      path, nlohmann::json{{"fingerprint", fingerprint}, {"outcome", outcome}}.dump());
}

}  // namespace towbench::study::procedures
