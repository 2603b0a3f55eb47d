// Another program that is talked to by lines: what is written goes to its standard input, what it prints on standard
// output is read. Its standard error is the caller's.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace hysteron {

// "python3 mine.py 'a b'" -> its words, as a shell parts them: by blanks, quotes and backslashes; nothing is expanded.
// Throws InputError for an empty command and an open quote.
std::vector<std::string> words_of_command(const std::string& command);

// "printed 'the line'", a long one cut, for messages about what a program said.
std::string printed(const std::string& line);

class LineProgram {
 public:
  // Starts it; the first word is looked for in PATH. Throws InputError where it cannot be started.
  explicit LineProgram(const std::vector<std::string>& words);
  LineProgram(const LineProgram&) = delete;
  LineProgram& operator=(const LineProgram&) = delete;
  LineProgram(LineProgram&&) = delete;
  LineProgram& operator=(LineProgram&&) = delete;
  // end(), where that was not called.
  ~LineProgram();

  // Writes a line. Throws WorkError where the program reads no more.
  void write(const std::string& line);
  // The next line, without its end; lines of blanks are passed over. Throws WorkError where there is none, Stopped
  // where a signal came.
  std::string read();
  // A line, or the beginning of one, that it has printed beyond what was read; blanks do not count. It is looked for
  // without waiting. Whoever is about to ask a question calls this: the line would be taken for the answer.
  [[nodiscard]] std::optional<std::string> unread();
  // Its standard input ends; a program that has not ended after two seconds is killed. Returns how it ended where that
  // was neither so nor with exit status 0: "'python3' ended with status 3".
  std::string end();

 private:
  // Takes in what can be read without waiting, up to a line that is not blank.
  void take_in();
  [[nodiscard]] std::string name() const { return "'" + words_.front() + "'"; }

  std::vector<std::string> words_;
  pid_t child_ = -1;
  int to_ = -1;
  int from_ = -1;
  std::string pending_;
};

}  // namespace hysteron
