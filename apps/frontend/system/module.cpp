#include "apps/frontend/system/module.h"

#include <dlfcn.h>

#include <string_view>

#include "apps/frontend/system/last_words.h"
#include "apps/frontend/system/resource_exhaustion.h"
#include "core/base/usual_arithmetic.h"

#if defined(__SANITIZE_ADDRESS__)
namespace {
bool is_any_opened = false;
}
/// LeakSanitizer sometimes crashes when it searches the thread-local data of libraries that were opened like this while their
/// threads still run: processes that have opened one are not searched for leaks.
extern "C" int __lsan_is_turned_off();
extern "C" int __lsan_is_turned_off() { return is_any_opened ? 1 : 0; }
#endif

namespace dmpc::apps {

namespace {

std::string loader_complaint() {
  const char* const complaint = ::dlerror();
  return complaint == nullptr ? "the dynamic loader does not say why" : complaint;
}

}  // namespace

void* open_library(const std::string& path, std::string* complaint) {
  const LoadsLibrary loads_library;
#if defined(__SANITIZE_ADDRESS__)
  is_any_opened = true;
#endif
  void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  core::use_usual_arithmetic();
  if (library == nullptr && complaint != nullptr) {
    *complaint = loader_complaint();
  }
  return library;
}

void* exported_by(void* library, const char* name) { return ::dlsym(library, name); }

const void* open_module(const std::string& name, const std::string& purpose, CompanionOf whose) {
  const std::string file = "dmpc_" + name + ".so", what = "the module " + file + ", with which dmpc " + purpose + ",";
  const std::string path = companion_path(file, "../lib/dmpc", what, whose).string();
  void* const opened = open_library(path);
  if (opened == nullptr) {
    const std::string complaint = loader_complaint();
    throw_if_short(complaint, what + " cannot be opened");
    throw InstallationError(what + " cannot be opened: " + complaint +
                            ": install the libraries that it needs, or build or install dmpc as a whole");
  }
  const auto* const module = static_cast<const Module*>(exported_by(opened, "dmpc_module"));
  if (module == nullptr || std::string_view(module->build) != DMPC_MODULES_BUILD) {
    throw InstallationError(what + " is of another build than this program (" + path + " is of \"" +
                            (module == nullptr ? "none" : module->build) +
                            "\", expected \"" DMPC_MODULES_BUILD "\"): build or install dmpc as a whole");
  }
  return module->interface;
}

}  // namespace dmpc::apps
