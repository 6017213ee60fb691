#include "harness/fmi/fmu_archive.h"

#include <algorithm>
#include <fstream>
#include <memory>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <zip.h>

namespace towbench::harness {
namespace {

constexpr zip_uint64_t kMostBytes = 1U << 28U;
constexpr zip_int64_t kMostEntries = 10'000;

using Archive = std::unique_ptr<zip_t, decltype(&zip_discard)>;

bool stays_inside(const std::string& name) {
  const std::filesystem::path path(name);
  return !name.empty() && !path.is_absolute() && name.find('\\') == std::string::npos &&
         name.find(':') == std::string::npos &&
         std::none_of(path.begin(), path.end(), [](const auto& part) { return part == ".."; });
}

struct Listed {
  zip_uint64_t index = 0;
  std::string name;
  zip_uint64_t bytes = 0;
};

std::string list(zip_t* archive, std::vector<Listed>& entries) {
  const auto count = zip_get_num_entries(archive, 0);
  if (count > kMostEntries) {
    return fmt::format("holds {} files, more than {}", count, kMostEntries);
  }
  zip_uint64_t total = 0;
  std::set<std::string> names;
  for (zip_int64_t i = 0; i < count; ++i) {
    zip_stat_t about{};
    const auto index = static_cast<zip_uint64_t>(i);
    constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE;
    if (zip_stat_index(archive, index, 0, &about) != 0 || (about.valid & kNeeded) != kNeeded) {
      return "is a broken archive";
    }
    const std::string name = about.name;
    if (!stays_inside(name)) {
      return fmt::format("holds \"{}\", a path outside the unit", name);
    }
    if (!names.insert(name).second) {
      return fmt::format("holds \"{}\" twice", name);
    }
    total = about.size > kMostBytes ? kMostBytes + 1 : total + about.size;
    if (total > kMostBytes) {
      return "is larger than 256 MiB when unpacked";
    }
    entries.push_back({index, name, about.size});
  }
  return {};
}

// As long as the archive's directory states, and to its end: there libzip compares the checksum.
bool unpack_one(zip_t* archive, const Listed& entry, const std::filesystem::path& folder) {
  const auto target = folder / entry.name;
  if (entry.name.ends_with('/')) {
    return std::filesystem::create_directories(target) || std::filesystem::is_directory(target);
  }
  std::filesystem::create_directories(target.parent_path());
  const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> file(
      zip_fopen_index(archive, entry.index, 0), zip_fclose);
  std::string bytes(entry.bytes, '\0');
  char more = '\0';
  if (!file ||
      zip_fread(file.get(), bytes.data(), bytes.size()) != static_cast<zip_int64_t>(entry.bytes) ||
      zip_fread(file.get(), &more, 1) != 0) {
    return false;
  }
  return static_cast<bool>(std::ofstream(target, std::ios::binary) << bytes);
}

}  // namespace

void write_fmu(const std::filesystem::path& file, const std::vector<FmuEntry>& entries) {
  int error = 0;
  Archive archive(zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error), zip_discard);
  const auto fail = [&] {
    throw std::runtime_error(fmt::format("{}: the archive cannot be written", file.string()));
  };
  if (!archive) {
    fail();
  }
  constexpr time_t kAnyTime = 946'684'800;  // 2000-01-01: no clock in the bytes
  for (const auto& entry : entries) {
    auto* const source =
        zip_source_buffer(archive.get(), entry.bytes.data(), entry.bytes.size(), 0);
    const auto index = zip_file_add(archive.get(), entry.name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0 ||
        zip_file_set_mtime(archive.get(), static_cast<zip_uint64_t>(index), kAnyTime, 0) != 0) {
      fail();
    }
  }
  if (zip_close(archive.get()) != 0) {
    fail();
  }
  (void)archive.release();
}

std::string unpack_fmu(const std::string& bytes, const std::filesystem::path& folder) {
  zip_error_t error{};
  auto* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  auto* const opened = zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error);
  if (opened == nullptr) {
    zip_source_free(source);
    return "is no ZIP archive, or a broken one";
  }
  const Archive archive(opened, zip_discard);
  std::vector<Listed> entries;
  if (auto wrong = list(archive.get(), entries); !wrong.empty()) {
    return wrong;
  }
  for (const auto& entry : entries) {
    if (!unpack_one(archive.get(), entry, folder)) {
      return fmt::format("is a broken archive at \"{}\"", entry.name);
    }
  }
  return {};
}

}  // namespace towbench::harness
