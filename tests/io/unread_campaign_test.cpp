// A campaign.toml that is not read, as what it lists is given without its folder, and numbers that are given twice.
#include "io/unread_campaign.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/conditions.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using testing::TemporaryFolder;

const std::string good = "time [s],displacement [mm],force [N]\n" + testing::ten_rows();
const std::string schema = "schema = \"hysteron.campaign/1\"\n";

// What is said of a campaign.toml that is not read, or of two numbers, without the folder's name.
std::string said_of(const TemporaryFolder& folder, const std::vector<std::string>& data, ReadOptions options = {},
                    const TakenOfCampaign& taken = {}) {
  std::string said;
  options.remark = [&](const Remark& remark) {
    if (!remark.key.starts_with("unread ") && !remark.key.starts_with("two numbers ")) return;
    const std::string here = folder.path().string() + "/";
    said += (remark.file.starts_with(here) ? remark.file.substr(here.size()) : remark.file) + ": " +
            remark.text.plain() + "\n";
  };
  std::vector<std::string> paths;
  for (const std::string& one : data) paths.push_back((folder.path() / one).string());
  static_cast<void>(load_campaign(paths, options, taken));
  return said;
}

TEST(UnreadCampaign, OfAFolderAboveThatListsTheRecordings) {
  const TemporaryFolder folder;
  for (const char* name : {"t/sub/r.csv", "t/sub/deep/s.csv", "t/sub/deep/er/q.csv", "t/other/r.csv"}) {
    folder.write(name, good);
  }
  folder.write("t/campaign.toml",
               schema +
                   "[[recording]]\nfile = \"./sub/r.csv\"\nrole = \"validate\"\n"
                   "[[recording]]\nfile = \"sub/deep/s.csv\"\n[[recording]]\nfile = \"sub/deep/er/q.csv\"\n");
  const std::string line =
      "t/campaign.toml: it is not read, as recordings that it lists are given without its folder, and its roles are "
      "not taken: expected the folder in their place, for what it says of them\n";
  EXPECT_EQ(said_of(folder, {"t/sub/r.csv", "t/sub/deep/s.csv"}), line);
  EXPECT_EQ(said_of(folder, {"t/sub/../sub/r.csv"}), line);
  EXPECT_EQ(said_of(folder, {"t/sub"}), line) << "as a folder";
  EXPECT_EQ(said_of(folder, {"t/sub/deep/s.csv"}), "") << "it says nothing of this one";
  EXPECT_EQ(said_of(folder, {"t/sub/deep/er/q.csv"}), "") << "three folders up";
  EXPECT_EQ(said_of(folder, {"t/other/r.csv"}), "") << "not listed";
  EXPECT_EQ(said_of(folder, {"t"}), "");
  EXPECT_EQ(said_of(folder, {"t", "t/other/r.csv"}), "") << "read already";
  EXPECT_EQ(said_of(folder, {"t/sub/r.csv"}, {}, recordings_alone), "");
}

// One that lists nothing is of the files of its folder alone, and so is one that cannot be read.
TEST(UnreadCampaign, OfAFolderAboveThatListsNothingSaysNothing) {
  const TemporaryFolder folder;
  folder.write("t/sub/r.csv", good);
  folder.write("t/campaign.toml", schema + "model = \"viscous\"\n");
  EXPECT_EQ(said_of(folder, {"t/sub/r.csv"}), "");
  folder.write("t/campaign.toml", "[tool]\nname = 3\n");
  EXPECT_EQ(said_of(folder, {"t/sub/r.csv"}), "");
}

// Of one who may still give model and laws.
TEST(UnreadCampaign, WhatMayBeGivenLaterIsSaid) {
  const TemporaryFolder folder;
  folder.write("r.csv", good);
  const TakenOfCampaign later{.given_later = true};
  folder.write("campaign.toml", schema + "model = \"viscous\"\n[by_current]\nc0 = 1\n");
  EXPECT_EQ(said_of(folder, {"r.csv"}, {}, later),
            "campaign.toml: it is not read, as recordings beside it are given one by one, and its model and laws are "
            "not taken: expected the folder in their place, for what it says of them, or its model and laws given to "
            "fit or diagnose\n");
  folder.write("campaign.toml", schema + "[[recording]]\nfile = \"r.csv\"\nrole = \"validate\"\n");
  EXPECT_EQ(said_of(folder, {"r.csv"}, {}, later),
            "campaign.toml: it is not read, as recordings beside it are given one by one, and its roles are not "
            "taken: expected the folder in their place, for what it says of them\n");
}

// On a file system that tells them apart.
TEST(UnreadCampaign, AFileOfAnotherCaseIsOffered) {
  const TemporaryFolder folder;
  folder.write("R0.csv", good);
  folder.write("campaign.toml", schema + "[[recording]]\nfile = \"r0.csv\"\n");
  const std::string said = testing::message_of<InputError>([&] { return said_of(folder, {""}); });
  EXPECT_NE(said.find("did you mean 'R0.csv'"), std::string::npos) << said;
}

// Units are converted by a product, whose rounding makes no other number.
TEST(TwoNumbers, AreComparedInOneUnit) {
  const TemporaryFolder folder;
  folder.write("r.csv", good);
  const auto said_at = [&](const std::string& name, const std::string& declared, const std::string& at) {
    folder.write("campaign.toml", schema + "[[recording]]\nfile = \"r.csv\"\n" + name + " = " + declared + "\n");
    ReadOptions options;
    options.numbers = {{name, *condition_number(at)}};
    return said_of(folder, {""}, options);
  };
  for (const char* at : {"210 kPa", "2.1 bar", "210000", "0.21 MPa"}) {
    EXPECT_EQ(said_at("pressure", "\"2.1 bar\"", at), "") << at;
  }
  for (const char* at : {"230 kPa", "0.23 MPa"}) EXPECT_EQ(said_at("pressure", "\"2.3 bar\"", at), "") << at;
  EXPECT_EQ(said_at("pressure", "\"1.1 bar\"", "110 kPa"), "");
  EXPECT_EQ(said_at("temperature", "20.1", "293.25 K"), "");
  EXPECT_EQ(said_at("temperature", "\"0.1 degC\"", "273.25 K"), "");
  EXPECT_EQ(said_at("pressure", "\"2.1 bar\"", "210.1 kPa"),
            "r.csv: its pressure is 210000 Pa by line 4 of campaign.toml and 210100 Pa by at, expected one number: "
            "that of at is taken\n");
}

}  // namespace
}  // namespace hysteron
