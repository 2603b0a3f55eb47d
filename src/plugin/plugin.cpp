#include "plugin/plugin.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "core/error.hpp"

namespace hysteron {

// Written by cmake/catalogue.cmake.
void add_to_model_catalogue(const Part* row);
void add_to_effect_catalogue(const Part* row);

namespace {

void check_free(const std::string& path, const char* kind, std::string_view id) {
  if (id.empty() || find_model(id) != nullptr || find_effect(id) != nullptr || find_solver(id) != nullptr ||
      find_solver_family(id) != nullptr) {
    throw InputError(path + ": its " + kind + " '" + std::string(id) +
                     "' has an id that is taken, expected one of its own");
  }
}

}  // namespace

void load_plugin(const std::string& path) {
  if (!std::filesystem::exists(path)) {
    throw InputError(path + ": no such file, expected a plugin library");
  }
  // With a slash, so that the loader takes the file and does not search for it.
  void* library = dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw InputError(path + ": cannot be loaded (" + dlerror() + "), expected a plugin library");
  }
  const auto entry = reinterpret_cast<const Plugin* (*)()>(dlsym(library, "hysteron_plugin"));
  if (entry == nullptr) {
    throw InputError(path + ": has no function hysteron_plugin, expected a plugin library");
  }
  const Plugin* plugin = entry();
  if (plugin == nullptr || plugin->layout != plugin_layout()) {
    throw InputError(
        path +
        ": was built for another version or instruction set of this program, expected one built with its headers");
  }
  for (const Part* part : plugin->models) {
    check_free(path, "model", part->id);
    add_to_model_catalogue(part);
  }
  for (const Part* part : plugin->effects) {
    check_free(path, "effect", part->id);
    add_to_effect_catalogue(part);
  }
  for (const SolverEntry* solver : plugin->solvers) {
    check_free(path, "solver", solver->id);
    add_solver(solver);
  }
}

}  // namespace hysteron
