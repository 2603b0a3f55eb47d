#include "io/campaign.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/error.hpp"
#include "io/csv.hpp"
#include "io/file.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using testing::message_of;
using testing::TemporaryFolder;

const std::string good = "time [s],displacement [mm],force [N]\n" + testing::ten_rows();
const std::string schema = "schema = \"hysteron.campaign/1\"\n";

std::vector<std::string> files_of(const Campaign& campaign) {
  std::vector<std::string> files;
  for (const auto& recording : campaign.recordings) files.push_back(recording.file);
  return files;
}

TEST(Campaign, FolderIsReadInBytewiseOrder) {
  const TemporaryFolder folder;
  for (const auto* name : {"b.csv", "a10.csv", "a2.CSV", "B.csv", ".hidden.csv", "notes.txt", "sub/x.csv"}) {
    folder.write(name, good);
  }
  const auto campaign = load_campaign({folder.path().string() + "/"});
  EXPECT_EQ(files_of(campaign), (std::vector<std::string>{"B.csv", "a10.csv", "a2.CSV", "b.csv"}));
  EXPECT_EQ(campaign.roles, std::vector<Role>(4, Role::unassigned));
  EXPECT_TRUE(campaign.model.empty());
  EXPECT_EQ(campaign.recordings[0].sha256, campaign.recordings[1].sha256);
}

TEST(Campaign, TomlNamesRecordingsRolesAndLaws) {
  const TemporaryFolder folder;
  folder.write("r1.csv", good);
  folder.write("r2.csv", good);
  folder.write("sub/r3.csv", good);
  folder.write("campaign.toml", schema +
                                    "model = \"bouc-wen\"\n[by_current]\nalpha = 1\nc0 = 2\n[by_frequency]\nk = 1\n"
                                    "[[recording]]\nfile = \"sub/r3.csv\"\nrole = \"validate\"\n"
                                    "[[recording]]\nfile = \"r1.csv\"\nrole = \"fit\"\n");
  const auto campaign = load_campaign({folder.path().string()});
  EXPECT_EQ(files_of(campaign), (std::vector<std::string>{"sub/r3.csv", "r1.csv"}));
  EXPECT_EQ(campaign.roles, (std::vector<Role>{Role::validate, Role::fit}));
  EXPECT_EQ(campaign.model, "bouc-wen");
  EXPECT_EQ(campaign.by_current, (std::map<std::string, int>{{"alpha", 1}, {"c0", 2}}));
  EXPECT_EQ(campaign.by_frequency, (std::map<std::string, int>{{"k", 1}}));
}

TEST(Campaign, ATomlOfAnotherNameIsTold) {
  const auto said_beside = [](const std::vector<std::string>& names) {
    const TemporaryFolder folder;
    folder.write("r1.csv", good);
    for (const std::string& name : names) folder.write(name, schema);
    std::vector<std::string> said;
    ReadOptions options;
    options.remark = [&](const Remark& remark) {
      EXPECT_TRUE(remark.file.starts_with(folder.path().string())) << remark.file;
      said.push_back(remark.file.substr(folder.path().string().size() + 1) + ": " + remark.text.plain());
    };
    EXPECT_EQ(load_campaign({folder.path().string()}, options).recordings.size(), 1U);
    return said;
  };
  const std::string rest = ": it is not read, and its roles and laws are not taken: expected the name campaign.toml";
  for (const std::string name : {"Campaign.toml", "campaign.toml.txt", "CAMPAIGN.TOML", "campaign (1).toml"}) {
    EXPECT_EQ(said_beside({name}), std::vector<std::string>{name + rest});
  }
  EXPECT_EQ(said_beside({"campaign.toml.txt", "Campaign.toml"}), std::vector<std::string>{"Campaign.toml" + rest});
  EXPECT_TRUE(said_beside({"campaign.toml", "campaign.toml.txt"}).empty()) << "a copy";
  EXPECT_TRUE(said_beside({"campaign.txt", "settings.toml", "campaign.csv.txt"}).empty());
}

TEST(Campaign, EqualNamesAreToldApartByFolder) {
  const TemporaryFolder folder;
  const auto a = folder.write("one/a/r.csv", good).string();
  const auto b = folder.write("one/b/r.csv", good).string();
  const auto c = folder.write("two/b/r.csv", good).string();
  const auto d = folder.write("d.csv", good).string();
  EXPECT_EQ(files_of(load_campaign({a, b, d})), (std::vector<std::string>{"a/r.csv", "b/r.csv", "d.csv"}));
  EXPECT_EQ(files_of(load_campaign({a, b, c})), (std::vector<std::string>{"a/r.csv", "one/b/r.csv", "two/b/r.csv"}));
  EXPECT_EQ(files_of(load_campaign({(folder.path() / "one/a").string(), (folder.path() / "one/b").string()})),
            (std::vector<std::string>{"a/r.csv", "b/r.csv"}));
}

TEST(Campaign, WrongTomlIsOneClearLine) {
  struct Case {
    const char* what;
    std::string toml;
    std::string message;  // after the path of campaign.toml
  };
  const std::string orders = " in [by_current] is not a whole number from 0 to 5, expected for example 1";
  const Case cases[] = {
      {"no schema", "model = \"x\"\n", ":1: no 'schema', expected schema = \"hysteron.campaign/1\""},
      {"newer schema", "schema = \"hysteron.campaign/2\"\n",
       ":1: unknown schema 'hysteron.campaign/2', expected 'hysteron.campaign/1'"},
      {"schema type", "schema = 1\n", ":1: 'schema' is not text, expected a string in double quotes"},
      {"unknown key", schema + "\nmodle = \"x\"\n",
       ":3: unknown key 'modle' (did you mean 'model'?), expected one of schema, model, by_current, by_frequency, by, "
       "recording"},
      {"model type", schema + "model = 3\n", ":2: 'model' is not text, expected a string in double quotes"},
      {"empty model", schema + "model = \"\"\n", ":2: 'model' is empty, expected the name of a model"},
      {"laws type", schema + "by_current = 1\n",
       ":2: 'by_current' is not a table, expected [by_current] with PARAMETER = ORDER"},
      {"order type", schema + "[by_current]\nalpha = 1.5\n", ":3: the order of 'alpha'" + orders},
      {"order range", schema + "[by_current]\nalpha = -1\n", ":3: the order of 'alpha'" + orders},
      {"recording type", schema + "recording = \"r1.csv\"\n",
       ":2: 'recording' is not an array of tables, expected [[recording]]"},
      {"no file", schema + "[[recording]]\nrole = \"fit\"\n",
       ":2: [[recording]] without 'file', expected file = \"NAME.csv\""},
      {"unknown recording key", schema + "[[recording]]\nfile = \"r1.csv\"\nrol = \"fit\"\n",
       ":4: unknown key 'rol' in [[recording]] (did you mean 'role'?), expected file, role, start, or a number of the "
       "recording such as pressure = 2.1e5 or \"2.1 "
       "bar\""},
      {"unknown role", schema + "[[recording]]\nfile = \"r1.csv\"\nrole = \"test\"\n",
       ":4: unknown role 'test', expected 'fit' or 'validate'"},
      {"missing file", schema + "[[recording]]\nfile = \"r9.csv\"\n",
       ":3: there is no recording 'r9.csv' in the folder (did you mean 'r1.csv'?), expected a file with one"},
      {"mistyped file", schema + "[[recording]]\nfile = \"r1.cvs\"\n",
       ":3: there is no recording 'r1.cvs' in the folder (did you mean 'r1.csv'?), expected a file with one"},
      {"another file", schema + "[[recording]]\nfile = \"campaign.csv\"\n",
       ":3: there is no recording 'campaign.csv' in the folder, expected a file with one"},
      {"absolute file", schema + "[[recording]]\nfile = \"/r1.csv\"\n",
       ":3: 'file' is '/r1.csv', expected a name relative to the folder"},
      {"file outside", schema + "[[recording]]\nfile = \"../r1.csv\"\n",
       ":3: 'file' is '../r1.csv', which leaves the folder, expected a name inside it"},
      {"file outside by a detour", schema + "[[recording]]\nfile = \"a/../../r1.csv\"\n",
       ":3: 'file' is 'a/../../r1.csv', which leaves the folder, expected a name inside it"},
      {"listed twice", schema + "[[recording]]\nfile = \"r1.csv\"\n[[recording]]\nfile = \"./r1.csv\"\n",
       ":5: recording 'r1.csv' is listed twice, expected each once"},
      {"nothing to fit", schema + "[[recording]]\nfile = \"r1.csv\"\nrole = \"validate\"\n",
       ":4: the only recording has the role validate, expected one with the role fit"},
  };
  for (const auto& c : cases) {
    const TemporaryFolder folder;
    folder.write("r1.csv", good);
    const auto toml = folder.write("campaign.toml", c.toml);
    EXPECT_EQ(message_of<InputError>([&] { (void)load_campaign({folder.path().string()}); }), toml.string() + c.message)
        << c.what;
  }
  const TemporaryFolder folder;
  const auto toml = folder.write("campaign.toml", schema + "model = \n");
  const auto message = message_of<InputError>([&] { (void)load_campaign({folder.path().string()}); });
  EXPECT_TRUE(message.starts_with(toml.string() + ":2: not valid TOML (")) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(Campaign, RecordingsThatAllJudgeAreReadWhereRolesAreNotTaken) {
  const TemporaryFolder folder;
  std::string toml = schema;
  for (const std::string name : {"r1.csv", "r2.csv"}) {
    folder.write(name, good);
    toml += "[[recording]]\nfile = \"" + name + "\"\nrole = \"validate\"\n";
  }
  const auto path = folder.write("campaign.toml", toml);
  EXPECT_EQ(message_of<InputError>([&] { (void)load_campaign({folder.path().string()}); }),
            path.string() + ":4: all 2 recordings have the role validate, expected one or more with the role fit");
  EXPECT_EQ(load_campaign({folder.path().string()}, {}, recordings_alone).recordings.size(), 2U);
}

// What is told of a folder whose recordings say these starts, and campaign.toml those; empty where none does.
std::vector<std::string> told_of_starts(const std::vector<std::pair<std::string, std::string>>& starts) {
  const TemporaryFolder folder;
  std::string toml = schema;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const std::string name = "r" + std::to_string(k + 1) + ".csv";
    const auto& [own, declared] = starts[k];
    folder.write(name, (own.empty() ? "" : "# start: " + own + "\n") + good);
    toml += "[[recording]]\nfile = \"" + name + "\"\n" + (declared.empty() ? "" : "start = " + declared + "\n");
  }
  folder.write("campaign.toml", toml);
  std::vector<std::string> said;
  ReadOptions options;
  options.remark = [&](const Remark& remark) {
    if (remark.text.plain().find("start") != std::string::npos)
      said.push_back(remark.file + ": " + remark.text.plain());
  };
  (void)load_campaign({folder.path().string()}, options);
  return said;
}

using Lines = std::vector<std::string>;

TEST(Campaign, AStartThatIsNotThatOfTheFileIsTold) {
  EXPECT_EQ(told_of_starts({{"2026-11-24T14:50:58", "2026-11-24T15:50:58"}, {"", "2026-11-24T16:00:00"}}),
            Lines{"r1.csv: it was started at 2026-11-24T15:50:58 by line 4 of campaign.toml and at 2026-11-24T14:50:58 "
                  "by the file itself, expected one start: that of campaign.toml is taken"});
  // The same, to the minute, and to the hour of a zone.
  for (const std::string same : {"2026-11-24T14:50:58", "2026-11-24T14:50:58.4", "2026-11-24T14:50:00",
                                 "2026-11-24T13:50:58Z", "2026-11-24T20:20:58+05:30"}) {
    const Lines said = told_of_starts({{"2026-11-24T14:50:58", same}});
    EXPECT_EQ(said, Lines{}) << same;
  }
  EXPECT_EQ(told_of_starts({{"2026-11-24T14:50:58", "2026-11-24T13:47:58Z"}}).size(), 1U);
}

TEST(Campaign, StartsWithAndWithoutAZoneAreTold) {
  const Lines told = {
      "r1.csv: its start, 2026-11-24T14:50:58, names no time zone, and that of r2.csv, 2026-11-24T15:00:00Z, is in "
      "UTC: "
      "it was taken in UTC as well; expected a zone in all starts or in none"};
  EXPECT_EQ(told_of_starts({{"2026-11-24T14:50:58", ""}, {"2026-11-24T15:00:00Z", ""}}), told);
  EXPECT_EQ(told_of_starts({{"2026-11-24T14:50:58", ""}, {"2026-11-24T16:00:00+01:00", ""}}), told);
  EXPECT_EQ(told_of_starts({{"", "2026-11-24T14:50:58"}, {"", "2026-11-24T15:00:00Z"}}), told);
  EXPECT_EQ(told_of_starts({{"2026-11-24T14:50:58", ""}, {"2026-11-24T15:00:00", "2026-11-24T15:00:00Z"}}), told);
  // Of one kind, whatever its offsets.
  EXPECT_EQ(told_of_starts({{"2026-11-24T14:50:58", ""}, {"2026-11-24T15:00:00", ""}}), Lines{});
  EXPECT_EQ(told_of_starts({{"2026-11-24T14:50:58Z", ""}, {"2026-11-24T16:00:00+01:00", ""}}), Lines{});
  EXPECT_EQ(told_of_starts({{"2026-11-24T14:50:58Z", ""}, {"2026-11-24T15:50:58", "2026-11-24T15:50:58-01:00"}}),
            Lines{});
}

TEST(Campaign, WrongArguments) {
  const TemporaryFolder folder;
  const auto path = folder.path().string();
  const auto message = [](std::vector<std::string> data) {
    return message_of<InputError>([&] { (void)load_campaign(data); });
  };
  EXPECT_EQ(message({}), "no recordings given, expected files or folders of them");
  EXPECT_EQ(message({path}),
            path + ": the folder holds no recordings, expected files such as .csv, .mat, .tdms, .mf4, .rsp or .xlsx");
  EXPECT_EQ(message({path + "/no.csv"}), path + "/no.csv: there is no such file, expected a readable file");
  const auto pdf = folder.write("a.pdf", "x").string();
  EXPECT_EQ(message({pdf}),
            pdf +
                ": unknown kind of file '.pdf', expected .csv, .txt, .tsv, .dat, .mat, .mf4, .mdf, .rsp, .rpc, .rpc3, "
                ".drv, .tim, .tdms, .xlsx or .xlsm, or a folder of recordings");
  const auto csv = folder.write("a.csv", good).string();
  EXPECT_EQ(message({csv, path + "/./a.csv"}), path + "/./a.csv: the recording is given twice, expected each once");
  EXPECT_EQ(message({path, csv}), csv + ": the recording is given twice, expected each once");
  EXPECT_EQ(message_of<InputError>([&] { (void)read_file(path); }), path + ": is a folder, expected a file");
}

TEST(Campaign, ContradictingFoldersAreRefused) {
  const TemporaryFolder folder;
  folder.write("a/r.csv", good);
  folder.write("b/r.csv", good);
  folder.write("a/campaign.toml", schema + "model = \"lugre\"\n[by_current]\nc0 = 1\n");
  const auto toml = folder.write("b/campaign.toml", schema + "model = \"bingham\"\n").string();
  const std::vector<std::string> data = {(folder.path() / "a").string(), (folder.path() / "b").string()};
  EXPECT_EQ(message_of<InputError>([&] { (void)load_campaign(data); }),
            toml + ": model 'bingham' contradicts 'lugre' of another folder, expected the same");
  folder.write("b/campaign.toml", schema + "[by_current]\nc0 = 2\n");
  EXPECT_EQ(message_of<InputError>([&] { (void)load_campaign(data); }),
            toml + ": order 2 of 'c0' in [by_current] contradicts order 1 of another folder, expected the same");
}

// A guard against an accidental quadratic; the usual figure is a few milliseconds.
TEST(Campaign, TwentyThousandRowsAreQuick) {
  std::string text = "time [s],displacement [mm],force [N]\n";
  for (int i = 0; i < 20000; ++i) {
    text += std::to_string(i * 1e-3) + "," + std::to_string(std::sin(0.03 * i)) + "," +
            std::to_string(100.0 * std::cos(0.03 * i)) + "\n";
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(parse_csv(text, "a.csv").size(), 20000U);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  RecordProperty("milliseconds", static_cast<int>(1e3 * taken.count()));
  EXPECT_LT(taken.count(), 2.0);
}

}  // namespace
}  // namespace hysteron
