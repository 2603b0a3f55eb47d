#include "challenge/seal.hpp"

#include "core/error.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "io/sha256.hpp"
#include "io/text.hpp"

namespace hysteron::challenge {
namespace {
constexpr auto answers_name = "answers.sealed";
constexpr auto seal_name = "seal.sha256";
}  // namespace

std::string seal(const nlohmann::json& answers, const std::filesystem::path& folder) {
  const std::string text = answers.dump(1) + "\n";
  std::string hash = sha256_hex(text);
  write_file_atomically(folder / answers_name, text);
  write_file_atomically(folder / seal_name, hash + "  " + answers_name + "\n");
  return hash;
}

nlohmann::json open_seal(const std::filesystem::path& folder, const std::string& published) {
  const std::string text = read_file(folder / answers_name);
  const std::string line = read_file(folder / seal_name);
  const std::string expected = published.empty() ? line.substr(0, 64) : published;
  const std::string actual = sha256_hex(text);
  if (actual != expected) {
    throw InputError((folder / answers_name).string(), 0,
                     "its hash is " + actual + ", expected the published " + in_quotes(expected));
  }
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception&) {
    throw InputError((folder / answers_name).string(), 0, "not valid JSON, expected the answers of a challenge");
  }
}

}  // namespace hysteron::challenge
