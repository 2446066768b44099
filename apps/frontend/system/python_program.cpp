#include "apps/frontend/system/python_program.h"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "apps/frontend/system/companion_path.h"
#include "apps/frontend/system/memory_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// Imports nothing from the current folder (-P). Its arguments: the module, what needs it, and the words for it.
/// While it imports, Ctrl-C just ends it.
constexpr const char* driver = R"(import importlib, signal, sys
signal.signal(signal.SIGINT, signal.SIG_DFL)
name, what, *words = sys.argv[1:]
try:
    module = importlib.import_module("dmpc." + name)
except ModuleNotFoundError as error:
    missing = error.name.split(".")[0]
    sys.exit(f"dmpc: {what} needs Python's module {missing}: apt-get install python3-{missing.lower()}"
             + (", or set PYTHONPATH to apps/python of the sources" if missing == "dmpc" else ""))
signal.signal(signal.SIGINT, signal.default_int_handler)
sys.exit(module.main(words))
)";

}  // namespace

std::string python() {
  constexpr const char* debian = "/usr/bin/python3";
  return ::access(debian, X_OK) == 0 ? debian : "python3";
}

std::vector<std::string> python_words(const std::string& name, const std::string& what, const std::vector<std::string>& words) {
  std::vector<std::string> line = {"-P", "-X", "utf8", "-c", driver, name, what};
  line.insert(line.end(), words.begin(), words.end());
  return line;
}

std::string file_for_python(std::string_view bytes) {
  const MemoryFile own;
  const int file = ::dup(own.descriptor());  // which stays open when this process becomes Python
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    core::expect(count > 0, "a file in memory takes what is written to it");
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return "/proc/self/fd/" + std::to_string(file);
}

void become_python(const std::string& name, const std::string& what, const std::vector<std::string>& words) {
  std::string program = python();
  std::vector<std::string> line = python_words(name, what, words);
  std::vector<char*> values = {program.data()};
  for (std::string& word : line) {
    values.push_back(word.data());
  }
  values.push_back(nullptr);
  ::setenv("DMPC", std::filesystem::read_symlink("/proc/self/exe").replace_filename("dmpc").c_str(), 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);  // dmpc holds back what Ctrl-C sends, and Python would inherit that
  ::execvp(program.c_str(), values.data());
  throw InstallationError(what + " needs Python: apt-get install python3-dmpc python3-matplotlib");
}

}  // namespace dmpc::apps
