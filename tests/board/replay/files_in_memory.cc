// Two files for a test image that has no file system: "inputs" lies in memory where the test put
// it, "outputs" is collected in memory where the test finds it.
#include "tests/board/replay/files_in_memory.h"

#include <cstdint>
#include <cstring>

#include <sys/stat.h>

#include "bbmc/baremetal/am335x.h"

using towbench::bbmc::MemoryFiles;
namespace am335x = towbench::bbmc::am335x;

extern "C" {

// Not zeroed by the start-up: the test fills it in before.
[[gnu::section(".data")]] MemoryFiles bbmc_memory_files;
extern char end[];

int _open(const char* name, int /*flags*/, int /*mode*/) {
  return std::strcmp(name, "inputs") == 0 ? 3 : 4;
}
int _read(int file, char* into, int size) {
  MemoryFiles& files = bbmc_memory_files;
  if (file != 3) {
    return 0;
  }
  const std::uint32_t left = files.input_size - files.input_taken;
  const std::uint32_t count = left < static_cast<std::uint32_t>(size) ? left : size;
  // A sign of life: an image that touches no peripheral for a second counts as hanging.
  [[maybe_unused]] const std::uint32_t alive = am335x::word(am335x::kUartLineStatus);
  std::memcpy(into, reinterpret_cast<const char*>(MemoryFiles::kInput) + files.input_taken, count);
  files.input_taken += count;
  return static_cast<int>(count);
}
int _write(int file, const char* from, int size) {
  MemoryFiles& files = bbmc_memory_files;
  if (file == 4) {
    std::memcpy(reinterpret_cast<char*>(MemoryFiles::kOutput) + files.output_size, from,
                static_cast<std::size_t>(size));
    files.output_size += static_cast<std::uint32_t>(size);
  } else {
    for (int i = 0; i < size; ++i) {  // what is said about trouble
      while ((am335x::word(am335x::kUartLineStatus) & 0x20U) == 0) {
      }
      am335x::word(am335x::kUartData) = static_cast<unsigned char>(from[i]);
    }
  }
  return size;
}
int _close(int /*file*/) {
  return 0;
}
int _lseek(int /*file*/, int /*offset*/, int /*whence*/) {
  return 0;
}
int _fstat(int /*file*/, struct stat* status) {
  std::memset(status, 0, sizeof *status);
  status->st_mode = S_IFREG;
  status->st_blksize = 65536;
  return 0;
}
int _isatty(int /*file*/) {
  return 0;
}
void* _sbrk(int size) {
  static char* top = end;
  char* const was = top;
  top += (size + 7) & ~7;
  return was;
}
int _kill(int /*process*/, int /*signal*/) {
  return -1;
}
int _getpid() {
  return 1;
}
[[noreturn]] void _exit(int status) {
  bbmc_memory_files.status = status;
  bbmc_memory_files.ended = 1;
  while (true) {
    asm volatile("wfi");
  }
}
void bbmc_interrupt() {}
void bbmc_halt() {
  _exit(255);
}
void _init() {}
void _fini() {}
}
void* __dso_handle = nullptr;

int replay_main(int argc, char** argv);
int main() {
  char program[] = "replay";
  char inputs[] = "inputs";
  char outputs[] = "outputs";
  char* arguments[] = {program, inputs, outputs, nullptr};
  _exit(replay_main(3, arguments));
}
