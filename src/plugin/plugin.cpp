#include "plugin/plugin.hpp"

#include <dlfcn.h>
#include <elf.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>

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

template <class T>
bool read_at(std::ifstream& file, std::uint64_t at, T& value) {
  file.seekg(static_cast<std::streamoff>(at));
  return static_cast<bool>(file.read(reinterpret_cast<char*>(&value), sizeof value));
}

// The loader maps what the headers name; what is behind the end of the file ends the program at the first touch.
bool is_complete(const std::string& path) {
  std::error_code code;
  const std::uint64_t size = std::filesystem::file_size(path, code);
  std::ifstream file(path, std::ios::binary);
  Elf64_Ehdr head{};
  if (code || !read_at(file, 0, head) || std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0) return false;
  if (head.e_ident[EI_CLASS] != ELFCLASS64 || head.e_phentsize != sizeof(Elf64_Phdr)) return false;
  const std::uint64_t sections = std::uint64_t{head.e_shnum} * head.e_shentsize;
  if (head.e_shoff > size || sections > size - head.e_shoff) return false;
  for (std::uint64_t k = 0; k < head.e_phnum; ++k) {
    Elf64_Phdr part{};
    if (head.e_phoff > size || !read_at(file, head.e_phoff + k * sizeof part, part)) return false;
    if (part.p_offset > size || part.p_filesz > size - part.p_offset) return false;
  }
  return true;
}

}  // namespace

namespace {

std::vector<std::string>& loaded() {
  static std::vector<std::string> files;
  return files;
}

}  // namespace

const std::vector<std::string>& loaded_plugins() { return loaded(); }

void load_plugin(const std::string& path) {
  if (!std::filesystem::exists(path)) {
    throw InputError(path + ": no such file, expected a plugin library");
  }
  if (!std::filesystem::is_regular_file(path) || !is_complete(path)) {
    throw InputError(path + ": cannot be loaded (no complete library), expected a plugin library");
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
  loaded().push_back(path);
}

}  // namespace hysteron
