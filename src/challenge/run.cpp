#include "challenge/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "challenge/concealed.hpp"
#include "challenge/score.hpp"
#include "challenge/seal.hpp"
#include "core/error.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "io/sha256.hpp"

namespace hysteron::challenge {
namespace {

using nlohmann::json;

// Calls work(0 .. count - 1) from `jobs` threads; the first exception stops the rest and is thrown again.
void in_parallel(std::size_t count, const Steps& steps, const std::string& stage,
                 const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::size_t done = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto loop = [&] {
    for (std::size_t k = next++; k < count && !steps.interrupted(); k = next++) {
      try {
        work(k);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
      const std::scoped_lock lock(mutex);
      ++done;
      steps.progress(stage, static_cast<double>(done) / static_cast<double>(count),
                     fmt::format("{} of {}", done, count));
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int k = 1; k < std::max(1, steps.jobs); ++k) threads.emplace_back(loop);
    loop();
  }
  if (failure) std::rethrow_exception(failure);
  if (steps.interrupted()) throw WorkError("interrupted; rerun the command to resume");
}

json settings_of(const std::vector<Task>& tasks, std::uint64_t seed) {
  json list = json::array();
  for (const Task& task : tasks) {
    list.push_back(
        {{"number", task.number}, {"level", name_of(task.level)}, {"effects", task.effects}, {"forms", task.forms}});
    if (task.stops) list.back()["stops"] = true;
    if (task.most_recordings > 0) list.back()["most_recordings"] = task.most_recordings;
  }
  // The tasks themselves would tell the answers; their hash tells whether they are the same.
  return {{"schema", "hysteron.challenge-settings/1"},
          {"seed", seed},
          {"campaigns", tasks.size()},
          {"tasks_sha256", sha256_hex(list.dump())}};
}

// Whether a campaign is one of those that a choice asks for.
bool holds_chosen(const json& answer, const FormChoice& choice) {
  bool wanted = choice.only.empty() && choice.foreign.empty();
  for (const auto& form : answer.value("forms", std::vector<std::string>{})) {
    const auto in = [&](const std::vector<std::string>& list) { return std::ranges::find(list, form) != list.end(); };
    if (in(choice.without)) return false;
    wanted = wanted || in(choice.only) || in(choice.foreign);
  }
  return wanted;
}

}  // namespace

std::string make_all(const std::filesystem::path& out, const std::vector<Task>& tasks, std::uint64_t seed,
                     const Steps& steps) {
  const std::string settings = settings_of(tasks, seed).dump(1) + "\n";
  if (std::filesystem::exists(out / "settings.json")) {
    if (read_file(out / "settings.json") != settings) {
      throw InputError((out / "settings.json").string(), 0,
                       "the folder holds a challenge with other settings, expected the same or a new folder");
    }
    if (std::filesystem::exists(out / "seal.sha256")) return read_file(out / "seal.sha256").substr(0, 64);
  }
  write_file_atomically(out / "settings.json", settings);
  std::vector<json> answers(tasks.size());
  in_parallel(tasks.size(), steps, "making campaigns", [&](std::size_t k) {
    const Concealed concealed = make_concealed(tasks[k], seed);
    write_recordings(concealed, (out / concealed.name).string(), seed);
    answers[k] = answer_of(concealed);
  });
  return seal({{"schema", "hysteron.answers/1"}, {"seed", seed}, {"campaigns", answers}}, out);
}

int diagnose_all(const std::filesystem::path& out, const Diagnose& diagnose, const Steps& steps) {
  std::vector<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() || !name.starts_with("campaign-")) continue;
    if (!std::filesystem::exists(out / "diagnoses" / name / "diagnosis.json")) folders.push_back(entry.path());
  }
  std::ranges::sort(folders);
  std::atomic<int> failed = 0;
  in_parallel(folders.size(), steps, "diagnosing", [&](std::size_t k) {
    const std::filesystem::path target = out / "diagnoses" / folders[k].filename();
    std::filesystem::create_directories(target);
    std::filesystem::remove(target / "failed.txt");
    try {
      diagnose(folders[k], target);
    } catch (const std::exception& error) {
      if (steps.interrupted()) return;
      ++failed;
      write_file_atomically(target / "failed.txt", std::string(error.what()) + "\n");
    }
  });
  return failed;
}

bool was_reached(const std::filesystem::path& diagnosis) {
  return std::filesystem::exists(diagnosis / "diagnosis.json") || std::filesystem::exists(diagnosis / "failed.txt");
}

json score_all(const std::filesystem::path& out, const std::string& hash, const FormChoice& choice) {
  const json answers = open_seal(out, hash);
  json campaigns = json::array();
  int left = 0;
  for (const json& answer : answers.at("campaigns")) {
    if (!holds_chosen(answer, choice)) continue;
    const auto folder = out / "diagnoses" / answer.at("campaign").get<std::string>();
    const auto path = folder / "diagnosis.json";
    json diagnosis;
    if (!was_reached(folder)) {
      ++left;
      continue;
    }
    if (std::filesystem::exists(path)) {
      try {
        diagnosis = json::parse(read_file(path));
      } catch (const json::exception&) {
        throw InputError(path.string(), 0, "not valid JSON, expected a diagnosis");
      }
    }
    campaigns.push_back(score_campaign(answer, diagnosis));
  }
  return {{"schema", "hysteron.challenge/1"},
          {"seed", answers.at("seed")},
          {"seal", read_file(out / "seal.sha256").substr(0, 64)},
          {"not_diagnosed", left},
          {"summary", summarise(campaigns)},
          {"campaigns", campaigns}};
}

}  // namespace hysteron::challenge
