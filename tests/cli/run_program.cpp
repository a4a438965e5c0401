#include "cli/run_program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "image/temporary_folder.h"

namespace brume {

RunningProgram::RunningProgram(const std::string& folder, const std::vector<std::string>& arguments,
                               const std::map<std::string, std::string>& environment)
    : log_(folder + "-log") {
  std::vector<char*> argv{const_cast<char*>("brume")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const std::string out = log_ + ".out", error = log_ + ".error";
  process_ = fork();
  if (process_ != 0) return;
  const int out_file = open(out.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  const int error_file = open(error.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  dup2(out_file, 1);
  dup2(error_file, 2);
  unsetenv("BRUME_ISA");
  for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
  if (out_file >= 0 && error_file >= 0 && chdir(folder.c_str()) == 0) execv(BRUME_PROGRAM, argv.data());
  _exit(126);
}

RunningProgram::~RunningProgram() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  for (const char* name : {".out", ".error"}) unlink((log_ + name).c_str());
}

void RunningProgram::send(int signal) const { kill(process_, signal); }

std::string RunningProgram::error() const { return bytes_of(log_ + ".error"); }

Outcome RunningProgram::wait() {
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, bytes_of(log_ + ".out"), error()};
}

Outcome run(const std::string& folder, const std::vector<std::string>& arguments,
            const std::map<std::string, std::string>& environment) {
  return RunningProgram(folder, arguments, environment).wait();
}

void write_small_scene(const std::string& path) {
  write_bytes_to(path,
                 R"(Film "rgb" "integer xresolution" 16 "integer yresolution" 12 "string filename" "named by scene.pfm"
Sampler "independent" "integer pixelsamples" 2
Integrator "classic" "integer maxdepth" 1 "string placement" "random" "float step" 0.1
Scale -1 1 1
LookAt 0 0 5  0 0 0  0 1 0
Camera "perspective" "float fov" 30
WorldBegin
LightSource "infinite" "rgb L" [0.1 0.2 0.3]
LightSource "distant" "rgb L" [3 3 3] "point3 from" [-1 1 1] "point3 to" [0 0 0]
MakeNamedMedium "m" "string type" "uniformgrid" "integer nx" 2 "integer ny" 2 "integer nz" 2
  "float density" [0 1 2 3 4 5 6 7] "point3 p0" [-1 -1 -1] "point3 p1" [1 1 1]
  "rgb sigma_s" [0.5 0.5 0.5] "rgb sigma_a" [0.1 0.1 0.1]
MediumInterface "m" ""
Shape "volume"
)");
}

}  // namespace brume
