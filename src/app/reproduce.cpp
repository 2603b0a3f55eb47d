#include "app/command.hpp"
namespace hysteron::app {
void add_reproduce(CLI::App& /*program*/) {}
}  // namespace hysteron::app
