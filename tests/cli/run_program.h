// Runs the built program in a folder of its own, as a user would.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

namespace brume {

struct Outcome {
  int exit_code = 0;  // 128 + signal where a signal ended the program
  std::string out, error;
};

// A program that is running; its outputs go to files in its folder's parent.
class RunningProgram {
 public:
  // Starts brume with `arguments` in `folder`; `environment` is added to ours.
  RunningProgram(const std::string& folder, const std::vector<std::string>& arguments,
                 const std::map<std::string, std::string>& environment = {});
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  ~RunningProgram();

  void send(int signal) const;
  // What it has written to stderr so far.
  std::string error() const;
  Outcome wait();

 private:
  std::string log_;  // prefix of the names of the two output files
  pid_t process_ = -1;
};

Outcome run(const std::string& folder, const std::vector<std::string>& arguments,
            const std::map<std::string, std::string>& environment = {});

// A scene that takes milliseconds: a uniform grid of eight voxels in front of a sky, 16 x 12 pixels, 2 samples each.
void write_small_scene(const std::string& path);

}  // namespace brume
