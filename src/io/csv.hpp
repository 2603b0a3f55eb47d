// Recordings from CSV text: comma, semicolon or tab, a header row with names and units, # comments.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// A recording in SI from the text of a CSV file; `file` names it in messages. The first row that is neither blank nor
// a comment holds names, with units in [] or () or in a row of their own below (none at all: SI). Columns that are no
// channel may hold anything. Decimal commas are read where the comma does not separate columns. Recording::file and
// sha256 are left empty. Everything wrong is an InputError with the line.
[[nodiscard]] Recording parse_csv(std::string_view text, const std::string& file, const ReadOptions& options = {});
// The same with units of the columns, in their order, that stand elsewhere than in the text; empty where none does.
[[nodiscard]] Recording parse_csv(std::string_view text, const std::string& file, const ReadOptions& options,
                                  const std::vector<std::string>& units);
// The same of a file, a few MiB of it in memory at a time; read twice where it is longer. Sets Recording::sha256.
[[nodiscard]] Recording read_csv(const std::filesystem::path& path, const ReadOptions& options = {});
// Lines of a file behind its first, comments and what comes before a header among them.
[[nodiscard]] std::size_t count_rows(const std::filesystem::path& path);

}  // namespace hysteron
