// Text with a row of names above rows of numbers: src/io/csv.hpp.
#include "io/csv.hpp"

#include "io/format.hpp"

namespace hysteron {
namespace {

constexpr Ending endings[] = {
    {".csv"}, {".txt", InFolders::none}, {".tsv", InFolders::none}, {".dat", InFolders::none}};

}  // namespace

extern const InputFormat format_csv;
const InputFormat format_csv = {.name = "CSV",
                                .endings = endings,
                                .begins = nullptr,
                                .parse = parse_csv,
                                .read = read_csv,
                                .samples = count_rows,
                                .lines = true};

}  // namespace hysteron
