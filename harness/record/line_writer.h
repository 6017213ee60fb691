// Appends text to a file, buffered; the unit of loss at a kill is a line.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace towbench::harness {

class LineWriter {
 public:
  // Creates the file. Throws std::filesystem::filesystem_error.
  explicit LineWriter(const std::filesystem::path& path);

  void write(std::string_view text) noexcept;
  void flush() noexcept;
  // False once a write has failed (disk full).
  [[nodiscard]] bool good() const noexcept { return good_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  bool good_ = true;
};

// Writes a whole file so that a reader sees the old one or the new one, never a part.
void write_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace towbench::harness
