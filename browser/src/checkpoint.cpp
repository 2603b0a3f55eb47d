// A page keeps nothing of an unfinished work.
#include "io/checkpoint.hpp"

namespace hysteron {

struct Checkpoint::Database {};

Checkpoint::Checkpoint(std::filesystem::path path, std::string_view /*command*/) : path_(std::move(path)) {}
Checkpoint::~Checkpoint() = default;

std::size_t Checkpoint::pieces() const { return 0; }
std::string Checkpoint::trouble() const { return {}; }
std::optional<std::string> Checkpoint::find(const std::string& /*key*/) const { return std::nullopt; }
void Checkpoint::keep(const std::string& /*key*/, std::string_view /*bytes*/) {}
void Checkpoint::remove() {}

}  // namespace hysteron
