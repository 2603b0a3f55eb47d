// Tables in GitHub-flavoured Markdown.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

// Columns are padded so that the source reads as a table too; columns of numbers are set flush right. `|` and line
// breaks inside a cell are escaped.
std::string markdown_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

}  // namespace hysteron
