// The process of a controller that the bench starts and ends, with all that it starts itself.
#pragma once

#include <filesystem>
#include <string>

#include <sys/types.h>

namespace towbench::harness {

class ControllerProcess {
 public:
  // By /bin/sh, in a process group of its own; what it prints goes to the file `output`, and it
  // has nothing to read. Throws std::system_error.
  ControllerProcess(const std::string& command, const std::filesystem::path& output);
  ControllerProcess(const ControllerProcess&) = delete;
  ControllerProcess& operator=(const ControllerProcess&) = delete;
  // Ends what is left of the group.
  ~ControllerProcess();

  // Whether it still runs.
  [[nodiscard]] bool runs();
  // Waits a little for its end, then ends it. How it ended, in words: "ended with code 1"; empty
  // when it ended by itself with 0.
  [[nodiscard]] std::string join();

 private:
  pid_t child_ = -1;
  bool ended_ = false;
  int status_ = 0;
};

}  // namespace towbench::harness
