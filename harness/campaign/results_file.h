// The lines that a campaign appends, one a case, as they are done.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace towbench::harness {

class ResultsFile {
 public:
  // Keeps what is there. A last line torn by a kill gets its end, so that it stands alone, is left
  // out when read, and its case is run again. Throws std::system_error.
  explicit ResultsFile(const std::filesystem::path& path);

  // Is in the file when this returns. Throws std::system_error when it cannot be written: a case
  // without a line was not run.
  void append(const std::string& line);

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace towbench::harness
