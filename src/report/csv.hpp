// Tables as CSV text (RFC 4180 with line feeds).
#pragma once

#include <string>
#include <vector>

namespace hysteron {

// Fields with commas, quotes or line breaks are put in double quotes.
[[nodiscard]] std::string csv_table(const std::vector<std::string>& header,
                                    const std::vector<std::vector<std::string>>& rows);

}  // namespace hysteron
