#include "hard/hard_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <cmath>

#include "mortise/io/csv_writer.hpp"

namespace mortise {
namespace {

std::string text_of(double value) { return std::isfinite(value) ? fmt::format("{:.5g}", value) : ""; }

std::string figure_of(const HardVerdict& verdict) {
  const HardFigure* worst = verdict.worst();
  return worst ? fmt::format("{} = {}", worst->name, text_of(worst->value)) : "";
}

std::string allowed_by(const HardVerdict& verdict) {
  const HardFigure* worst = verdict.worst();
  return worst ? worst->allowed() : "";
}

/// "right", or what is wrong with it, in bold.
std::string said(const HardVerdict& verdict) {
  const std::string name = verdict.verdict == Verdict::wrong ? "**wrong**" : to_string(verdict.verdict);
  return verdict.why.empty() ? name : name + ": " + verdict.why;
}

/// The rows of a case.
std::vector<const HardRow*> rows_of(const std::vector<HardRow>& rows, std::size_t number) {
  std::vector<const HardRow*> found;
  for (const HardRow& row : rows)
    if (row.line->number == number) found.push_back(&row);
  return found;
}

std::string wrong_lines(const HardPlan& plan, std::size_t number, const std::vector<HardRow>& rows) {
  const auto all = rows_of(rows, number);
  const auto wrong = std::count_if(all.begin(), all.end(), [](const HardRow* row) { return row->verdict.verdict == Verdict::wrong; });
  return fmt::format("{} of {} lines of {} wrong", wrong, all.size(), plan.cases[number].name);
}

/// A given text in Markdown, whose readers take HTML too.
std::string markdown(std::string text) {
  for (const auto& [from, to] : {std::pair{"&", "&amp;"}, {"<", "&lt;"}}) boost::replace_all(text, from, to);
  return text;
}

/// A cell of a Markdown table.
std::string cell(std::string text) {
  text = markdown(text);
  boost::replace_all(text, "|", "\\|");
  boost::replace_all(text, "\n", " ");
  return text;
}

std::string row_of(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const auto& one : cells) line += " " + cell(one) + " |";
  return line + "\n";
}

std::string counts(const HardRow& row) { return fmt::format("{} / {} / {}", row.outcome.steps, row.outcome.cutbacks, row.outcome.iterations); }

std::string html_cell(std::string text) {
  for (const auto& [from, to] : {std::pair{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}}) boost::replace_all(text, from, to);
  return "<td>" + text + "</td>";
}

constexpr const char* style = R"(<style>
body { font: 14px/1.4 sans-serif; margin: 2em; } table { border-collapse: collapse; } td, th { border: 1px solid #ccc; padding: 3px 7px; vertical-align: top; text-align: left; }
tr.right td.verdict { background: #d9f2d9; } tr.stopped td.verdict { background: #fff3c4; } tr.wrong td.verdict { background: #f7caca; }
</style>
)";

const char* class_of(Verdict verdict) { return verdict == Verdict::right ? "right" : verdict == Verdict::stopped ? "stopped" : "wrong"; }

}  // namespace

std::string count_verdicts(const std::vector<HardRow>& rows) {
  const auto count = [&](Verdict verdict) {
    return std::count_if(rows.begin(), rows.end(), [&](const HardRow& row) { return row.verdict.verdict == verdict; });
  };
  return fmt::format("{} right, {} stopped with a true reason, {} wrong", count(Verdict::right), count(Verdict::stopped), count(Verdict::wrong));
}

void write_hard_table(const RCP<const Communicator>& comm, const std::string& path, const HardPlan& plan, const std::vector<HardRow>& rows) {
  const std::vector<std::string> columns{"case",  "point",    "ranks",      "verdict", "figure", "value", "low",         "high",  "outcome",
                                         "steps", "cutbacks", "iterations", "seconds", "why",    "hard",  "expectation", "source"};
  std::vector<std::vector<CsvValue>> table;
  for (const HardRow& row : rows) {
    const auto& one = plan.case_of(*row.line);
    const HardFigure* worst = row.verdict.worst();
    const auto number = [](double value) { return std::isfinite(value) ? CsvValue(value) : CsvValue(std::string()); };
    table.push_back({one.name, row.line->label, static_cast<long long>(row.ranks), to_string(row.verdict.verdict),
                     worst ? worst->name : std::string(), worst ? number(worst->value) : CsvValue(std::string()),
                     worst ? number(worst->low) : CsvValue(std::string()), worst ? number(worst->high) : CsvValue(std::string()),
                     row.outcome.record.status(), static_cast<long long>(row.outcome.steps), static_cast<long long>(row.outcome.cutbacks),
                     static_cast<long long>(row.outcome.iterations), number(row.outcome.record.wall), row.verdict.why, one.value.hard,
                     one.value.expectation, one.value.source});
  }
  CsvWriter(comm, path, columns).rows(table);
}

std::string hard_markdown(const HardPlan& plan, const std::vector<HardRow>& rows, const std::string& version) {
  std::string page = fmt::format(
      "# Hard cases\n\nWritten by `mortise hard` ([how](../hard.md)), program {}; do not edit. {}.\n\nA figure stands beside what is allowed; of "
      "several, the one that uses "
      "most of what is allowed. Steps / cutbacks / iterations count tries that were undone as well.\n\n## Cases\n\n",
      version, count_verdicts(rows));
  page += row_of({"case", "ranks", "what makes it hard", "expected", "source", "steps / cutbacks / iterations", "figure", "allowed", "verdict"});
  page += "|---|---|---|---|---|---|---|---|---|\n";
  for (const HardRow& row : rows) {
    const auto& one = plan.case_of(*row.line);
    if (!one.value.axes.empty()) continue;
    page += row_of({one.name, std::to_string(row.ranks), one.value.hard, one.value.expectation, one.value.source, counts(row), figure_of(row.verdict),
                    allowed_by(row.verdict), said(row.verdict)});
  }
  for (std::size_t number = 0; number < plan.cases.size(); ++number) {
    const auto& one = plan.cases[number];
    if (one.value.axes.empty()) continue;
    page += markdown(fmt::format("\n## Sweep: {}\n\n{}. Expected: {} ({}). {}.\n\n", one.name, one.value.hard, one.value.expectation,
                                 one.value.source, wrong_lines(plan, number, rows)));
    page += row_of({"of it", "ranks", "steps / cutbacks / iterations", "figure", "allowed", "verdict"}) + "|---|---|---|---|---|---|\n";
    for (const HardRow* row : rows_of(rows, number))
      page +=
          row_of({row->line->label, std::to_string(row->ranks), counts(*row), figure_of(row->verdict), allowed_by(row->verdict), said(row->verdict)});
  }
  return page;
}

std::string hard_html(const HardPlan& plan, const std::vector<HardRow>& rows, const std::string& version) {
  std::string page = "<!doctype html><meta charset=\"utf-8\"><title>Hard cases</title>\n" + std::string(style);
  page += fmt::format("<h1>Hard cases</h1><p>Program {}. {}.</p>\n<table><tr>", version, count_verdicts(rows));
  for (const char* name : {"case", "of it", "ranks", "verdict", "figure", "allowed", "outcome", "steps", "cutbacks", "iterations", "seconds", "why",
                           "what makes it hard", "expected", "source"})
    page += fmt::format("<th>{}</th>", name);
  page += "</tr>\n";
  for (const HardRow& row : rows) {
    const auto& one = plan.case_of(*row.line);
    page += fmt::format("<tr class=\"{}\">", class_of(row.verdict.verdict));
    page += html_cell(one.name) + html_cell(row.line->label) + html_cell(std::to_string(row.ranks));
    page += fmt::format("<td class=\"verdict\">{}</td>", to_string(row.verdict.verdict));
    for (const std::string& text :
         {figure_of(row.verdict), allowed_by(row.verdict), row.outcome.record.status(), std::to_string(row.outcome.steps),
          std::to_string(row.outcome.cutbacks), std::to_string(row.outcome.iterations), fmt::format("{:.2f}", row.outcome.record.wall),
          row.verdict.why, one.value.hard, one.value.expectation, one.value.source})
      page += html_cell(text);
    page += "</tr>\n";
  }
  return page + "</table>\n";
}

}  // namespace mortise
