#include "study/logs/mat_process.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "study/logs/table.h"

namespace towbench::study::logs {
namespace {

constexpr rlim_t kLongestReading_s = 60;
constexpr int kTaken = 0;
constexpr int kRefused = 3;

using File = std::unique_ptr<std::FILE, decltype([](std::FILE* file) { std::fclose(file); })>;

// Between the two processes: a count of numbers or of signs, then these.
template <typename T>
void put(std::FILE* out, const T* data, std::uint64_t count) {
  std::fwrite(&count, sizeof count, 1, out);
  std::fwrite(data, sizeof(T), count, out);
}

template <typename Container>
bool take(std::FILE* in, Container& into, std::uint64_t most) {
  std::uint64_t count = 0;
  if (std::fread(&count, sizeof count, 1, in) != 1 || count > most) {
    return false;
  }
  into.resize(count);
  return std::fread(into.data(), sizeof *into.data(), count, in) == count;
}

[[noreturn]] void read_and_tell(const char* path, int end) {
  const rlimit time{kLongestReading_s, kLongestReading_s};
  const rlimit core{0, 0};
  setrlimit(RLIMIT_CPU, &time);
  setrlimit(RLIMIT_CORE, &core);
  std::vector<MatColumn> columns;
  const bool read = read_mat_columns(path, columns);
  File out(fdopen(end, "wb"));
  for (const MatColumn& column : columns) {
    put(out.get(), column.name.data(), column.name.size());
    put(out.get(), column.left_out.data(), column.left_out.size());
    put(out.get(), column.values.data(), column.values.size());
  }
  out.reset();
  _exit(read ? kTaken : kRefused);
}

std::string told_by(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("damaged: it ends the reader of MAT files (signal {})", WTERMSIG(status));
  }
  return WEXITSTATUS(status) == kTaken ? "" : "no MAT file of version 4, 5 or 7.3, or damaged";
}

}  // namespace

std::string read_mat_apart(const std::filesystem::path& path, std::vector<MatColumn>& columns) {
  int ends[2];
  if (pipe(ends) != 0) {
    return "no pipe for the reader of MAT files";
  }
  std::fflush(nullptr);
  const pid_t reader = fork();
  if (reader == 0) {
    close(ends[0]);
    read_and_tell(path.c_str(), ends[1]);
  }
  close(ends[1]);
  File in(fdopen(ends[0], "rb"));
  constexpr std::uint64_t kLongestName = 4096;
  MatColumn column;
  while (take(in.get(), column.name, kLongestName) &&
         take(in.get(), column.left_out, kLongestName) &&
         take(in.get(), column.values, kMostRows)) {
    columns.push_back(column);
  }
  in.reset();
  int status = 0;
  if (reader < 0 || waitpid(reader, &status, 0) != reader) {
    return "no process for the reader of MAT files";
  }
  return told_by(status);
}

}  // namespace towbench::study::logs
