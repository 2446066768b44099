#include "apps/system/module.h"

#include <dlfcn.h>

#include <string_view>

#include "apps/system/companion_path.h"
#include "apps/system/last_words.h"
#include "apps/system/shortage.h"

namespace dmpc::apps {

namespace {

std::string loader_complaint() {
  const char* const complaint = ::dlerror();
  return complaint == nullptr ? "the dynamic loader does not say why" : complaint;
}

/// Its libraries may start threads as they are loaded.
void* load(const std::string& path) {
  const LoadsLibrary loads_library;
  return ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
}

}  // namespace

const void* open_module(const std::string& name, const std::string& purpose) {
  const std::string file = "dmpc_" + name + ".so", what = "the module " + file + ", with which dmpc " + purpose + ",";
  const std::string path = companion_path(file, "../lib/dmpc", what).lexically_normal().string();
  void* const opened = load(path);
  if (opened == nullptr) {
    const std::string complaint = loader_complaint();
    throw_if_short(complaint, what + " cannot be opened");
    throw InstallationError(what + " cannot be opened: " + complaint +
                            ": install the libraries that it needs, or build or install dmpc as a whole");
  }
  const auto* const module = static_cast<const Module*>(::dlsym(opened, "dmpc_module"));
  if (module == nullptr || std::string_view(module->build) != DMPC_MODULES_BUILD) {
    throw InstallationError(what + " is of another build than this program (" + path + " is of \"" +
                            (module == nullptr ? "none" : module->build) +
                            "\", expected \"" DMPC_MODULES_BUILD "\"): build or install dmpc as a whole");
  }
  return module->interface;
}

}  // namespace dmpc::apps
