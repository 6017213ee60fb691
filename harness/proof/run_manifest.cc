#include "harness/proof/run_manifest.h"

#include <fstream>
#include <map>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/proof/record_key.h"
#include "harness/proof/sha256.h"

namespace towbench::harness {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Digests = std::map<std::string, FileDigest>;

constexpr int kSchema = 1;

// Made after the run from what is listed, so that it may be made again.
bool is_listed(const std::string& name) {
  return name != kManifestFile && name != "report.html" && !name.ends_with(".part");
}

bool every_file(const std::string&) {
  return true;
}

Digests digests_in(const fs::path& folder, const FileChoice& chosen) {
  Digests digests;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const auto name = entry->path().lexically_relative(folder).generic_string();
    std::error_code ignored;
    if (is_listed(name) && chosen(name) && !entry->is_directory(ignored)) {
      digests[name] = digest_of(entry->path());
    }
  }
  return digests;
}

json files_json(const Digests& digests) {
  json files = json::object();
  for (const auto& [name, digest] : digests) {
    files[name] = {{"sha256", digest.sha256}, {"bytes", digest.bytes}, {"lines", digest.lines}};
  }
  return files;
}

// What is signed: the members of an object stand in the order of their names, so the text is one.
std::string signed_text(const json& files) {
  return "towbench run folder 1\n" + files.dump(-1, ' ', true, json::error_handler_t::replace);
}

json signature_json(const json& files) {
  const auto key = record_key();
  return key ? json{{"key", name_of_key(*key)},
                    {"hmac_sha256", hmac_sha256(*key, signed_text(files))}}
             : json(nullptr);
}

std::optional<json> read_manifest(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    return std::nullopt;
  }
  std::ifstream stream(file);
  return json::parse(stream, nullptr, false);
}

std::string text_of(const json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

FileDigest recorded_digest(const json& entry) {
  FileDigest digest;
  digest.sha256 = text_of(entry, "sha256");
  const auto count = [&](const char* key) {
    const auto found = entry.is_object() ? entry.find(key) : entry.end();
    return found != entry.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0U;
  };
  digest.bytes = count("bytes");
  digest.lines = count("lines");
  return digest;
}

std::string difference(const std::string& name, const FileDigest& recorded,
                       const FileDigest& found) {
  if (found.sha256.empty()) {
    return name + " cannot be read.";
  }
  if (recorded.lines != found.lines) {
    return fmt::format("{} has {} lines, {} were recorded.", name, found.lines, recorded.lines);
  }
  if (recorded.bytes != found.bytes) {
    return fmt::format("{} has {} bytes, {} were recorded.", name, found.bytes, recorded.bytes);
  }
  return name + " holds other bytes than were recorded: its SHA-256 differs.";
}

void compare_files(const json& files, const Digests& found, const FileChoice& chosen,
                   std::vector<std::string>& problems) {
  for (const auto& [name, entry] : files.items()) {
    if (!chosen(name)) {
      continue;
    }
    const auto file = found.find(name);
    if (file == found.end()) {
      problems.push_back(name + " was recorded and is missing.");
    } else if (const auto recorded = recorded_digest(entry); recorded != file->second) {
      problems.push_back(difference(name, recorded, file->second));
    }
  }
  for (const auto& [name, digest] : found) {
    if (!files.contains(name)) {
      problems.push_back(name + " was not recorded with this run.");
    }
  }
}

Origin check_signature(const json& manifest, std::vector<std::string>& problems) {
  const auto signature = manifest.find("signature");
  const auto key = record_key();
  if (signature == manifest.end() || !key || text_of(*signature, "key") != name_of_key(*key)) {
    return Origin::kUnknown;
  }
  if (text_of(*signature, "hmac_sha256") != hmac_sha256(*key, signed_text(manifest.at("files")))) {
    problems.emplace_back("manifest.json was changed after it was signed.");
    return Origin::kUnknown;
  }
  return Origin::kHere;
}

}  // namespace

void write_manifest(const fs::path& folder) {
  const auto files = files_json(digests_in(folder, every_file));
  const json manifest{{"schema", kSchema}, {"files", files}, {"signature", signature_json(files)}};
  const auto target = folder / kManifestFile;
  auto unfinished = target;
  unfinished += ".part";
  {
    constexpr int kIndent = 1;
    std::ofstream stream(unfinished, std::ios::binary | std::ios::trunc);
    stream << manifest.dump(kIndent, ' ', true, json::error_handler_t::replace) << '\n';
    stream.flush();
    if (!stream) {
      throw fs::filesystem_error("cannot write", unfinished,
                                 std::make_error_code(std::errc::io_error));
    }
  }
  fs::rename(unfinished, target);
}

ManifestCheck check_manifest(const fs::path& folder) {
  return check_manifest(folder, every_file);
}

ManifestCheck check_manifest(const fs::path& folder, const FileChoice& chosen) {
  ManifestCheck check;
  const auto manifest = read_manifest(folder / kManifestFile);
  if (!manifest) {
    return check;
  }
  check.present = true;
  if (!manifest->is_object() || !manifest->contains("files") ||
      !manifest->at("files").is_object()) {
    check.problems.emplace_back("manifest.json cannot be read as a manifest.");
    return check;
  }
  compare_files(manifest->at("files"), digests_in(folder, chosen), chosen, check.problems);
  check.origin = check_signature(*manifest, check.problems);
  return check;
}

std::string_view sentence_for(Origin origin) noexcept {
  return origin == Origin::kHere
             ? "recorded by this user on this machine, unchanged since"
             : "unknown: every file has its recorded hash, but not under this user's key";
}

}  // namespace towbench::harness
