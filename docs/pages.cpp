#include "docs/pages.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/xml.hpp"
#include "docs/ledger.hpp"
#include "docs/measured.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <ranges>
#include <regex>
#include <sstream>
#include <utility>
#include <vector>

namespace space::docs {
namespace {

namespace fs = std::filesystem;

/// An exercise as the head of its stub describes it.
struct Exercise {
    std::string chapter, name;  ///< "ch01_naive_ray_tracing", "ex02_shadow_test"
    std::string id, title;      ///< "1.2", "The missing occlusion test"
    int difficulty = 0, minutes = 0;
    std::string task;  ///< Doxygen text
};

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// What stands in place of a figure whose file is not there.
std::string absent(const Figure& figure) {
    return fmt::format("<b>Figure {} is not here</b>: `./book run {}` makes it.", number_of(figure),
                       std::stoi(figure.id.substr(4, 2)));
}

Exercise read_exercise(const Places& places, const std::string& chapter, const std::string& name) {
    const fs::path stub = places.root / "chapters" / chapter / "exercises" / (name + ".hpp");
    const std::vector<std::string> lines = lines_of(read_file(stub));
    static const std::regex title(R"(/// Exercise (\d+\.\d+): (.+))");
    static const std::regex effort(R"(/// Difficulty (\d) of 3, about (\d+) minutes\.)");
    std::smatch first, second;
    if (lines.size() < 3 || !std::regex_match(lines[1], first, title) ||
        !std::regex_match(lines[2], second, effort))
        throw input_error(fmt::format(
            "{}:2: expected \"/// Exercise N.M: title\" and then \"/// Difficulty D of 3, "
            "about M minutes.\"",
            stub.string()));
    Exercise exercise{.chapter = chapter,
                      .name = name,
                      .id = first[1],
                      .title = first[2],
                      .difficulty = std::stoi(second[1]),
                      .minutes = std::stoi(second[2]),
                      .task = {}};
    for (std::size_t i = 3; i < lines.size() && lines[i].starts_with("///"); ++i)
        exercise.task += (lines[i].size() > 4 ? lines[i].substr(4) : "") + "\n";
    return exercise;
}

std::vector<Exercise> read_exercises(const Places& places) {
    std::vector<Exercise> exercises;
    for (const std::string& line : lines_of(read_file(places.configured / "exercises.txt")))
        if (const std::size_t slash = line.find('/'); slash != std::string::npos)
            exercises.push_back(
                read_exercise(places, line.substr(0, slash), line.substr(slash + 1)));
    return exercises;
}

/// The id of the page that a .dox file holds; nothing where there is no such file.
std::optional<std::string> page_id(const fs::path& file) {
    if (!exists(file)) return std::nullopt;
    static const std::regex page(R"([\\@]page\s+(\S+))");
    const std::string text = read_file(file);
    std::smatch match;
    if (!std::regex_search(text, match, page))
        throw input_error(fmt::format("{}: no \\page in it", file.string()));
    return match[1].str();
}

std::optional<std::string> page_id(const Places& places, const Chapter& chapter) {
    if (!chapter.here && chapter.begun.empty()) return std::nullopt;
    return page_id(places.root / "chapters" / chapter.folder / "chapter.dox");
}

/// The title after the id.
std::string page_title(const fs::path& file) {
    static const std::regex page(R"([\\@]page\s+\S+\s+(.+))");
    const std::string text = read_file(file);
    std::smatch match;
    if (!std::regex_search(text, match, page))
        throw input_error(fmt::format("{}: its \\page has no title", file.string()));
    return match[1].str();
}

/// Raw HTML within a page. The block ends before an \endhtmlonly only.
std::string raw(const std::string& markup) {
    return "\\htmlonly\n" + markup + "\\endhtmlonly\n\n";
}

std::string plural(std::size_t count, const std::string& word) {
    return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

std::string source_links(const std::vector<std::string>& sources) {
    std::vector<std::string> links;
    for (const std::string& source : sources)
        links.push_back(fmt::format("<a href=\"bibliography.html#{}\">{}</a>", source, source));
    return fmt::format("{}", fmt::join(links, ", "));
}

std::string chapter_table(const Places& places, const std::vector<Chapter>& chapters,
                          const std::vector<Figure>& figures,
                          const std::vector<Exercise>& exercises,
                          const std::vector<Claim>& claims) {
    std::string rows;
    for (const Chapter& chapter : chapters) {
        const auto owed = std::ranges::count_if(claims, [&](const Claim& claim) {
            return std::ranges::find(claim.chapters, chapter.number) != claim.chapters.end();
        });
        std::string title = xml_escaped(chapter.title),
                    state = chapter.begun.empty() ? "to come" : chapter.begun;
        if (const auto page = page_id(places, chapter))
            title = fmt::format("<a href=\"{}.html\">{}</a>", *page, title);
        if (chapter.here)
            state = fmt::format(
                "<a href=\"figures.html#figures_{0}\">{1}</a> <a "
                "href=\"exercises.html#exercises_{0}\">{2}</a>",
                chapter.folder,
                plural(std::ranges::count(figures, chapter.folder, &Figure::chapter), "figure"),
                plural(std::ranges::count(exercises, chapter.folder, &Exercise::chapter),
                       "exercise"));
        if (chapter.here && owed > 0)
            state += fmt::format(" <a href=\"ledger.html#claims_{}\">{}</a>", chapter.folder,
                                 plural(owed, "claim"));
        rows += fmt::format(
            "<li class=\"{}\"><span class=\"number\">{}</span><div><b>{}</b><p>{}</p></div><span "
            "class=\"state\">{}</span></li>\n",
            chapter.here ? "here" : "to-come", chapter.number, title, xml_escaped(chapter.teaches),
            state);
    }
    return raw("<ol class=\"chapters\">\n" + rows + "</ol>\n");
}

/// Powers, indices and arrows as they are set in a book; results and heads of exercises are plain
/// text, which is read on a terminal, too.
std::string typeset(std::string text) {
    static const std::pair<std::regex, const char*> rules[] = {
        {std::regex(R"(\*u(24|53)\*)"), "*u*<sub>$1</sub>"},
        {std::regex(R"(\^-(\w+))"), "<sup>−$1</sup>"},
        {std::regex(R"(\^(\w+))"), "<sup>$1</sup>"},
        {std::regex(R"(\blog2\b)"), "log<sub>2</sub>"},
        {std::regex(R"(\s-(>|&gt;)\s)"), " → "},
        {std::regex(R"((>|&gt;)= )"), "≥ "},
        {std::regex(R"(\n\*)"), " *"}};  // Doxygen takes away what begins a comment's line
    for (const auto& [plain, set] : rules) text = std::regex_replace(text, plain, set);
    return text;
}

std::string exercises_page(const std::vector<Chapter>& chapters,
                           const std::vector<Exercise>& exercises) {
    std::string text =
        "/*! \\page exercises Exercises\n\\tableofcontents{HTML:2}\n"
        "Each exercise is one small header of the book with something wrong or missing. It "
        "compiles as it stands. "
        "Change it until its check agrees:\n\n"
        "- `./book exercise` lists all exercises, and which of them are solved;\n"
        "- `./book exercise check 1.1` compiles and checks yours; a failed check says what it "
        "expected;\n"
        "- `./book exercise hint 1.1` gives the first hint, then the second, then the third;\n"
        "- `./book exercise solution 1.1` shows a solution;\n"
        "- `./book exercise reset 1.1` puts the untouched file back.\n\n"
        "Checks count and compare; none of them measures time. A check stops what runs for more "
        "than a minute, takes more than 2 GB of memory or prints more than 10 MB. Each chapter "
        "also has problems for paper, a measurement to predict and a project, at its end; notes "
        "for teachers and answers to these are in the folder `docs/teachers`.\n\n";
    for (const Chapter& chapter : chapters) {
        if (std::ranges::count(exercises, chapter.folder, &Exercise::chapter) == 0) continue;
        text += fmt::format("\\section exercises_{} Chapter {}: {}\n\n", chapter.folder,
                            chapter.number, chapter.title);
        for (const Exercise& exercise : exercises) {
            if (exercise.chapter != chapter.folder) continue;
            std::string dots;
            for (int i = 1; i <= 3; ++i) dots += i <= exercise.difficulty ? "●" : "○";
            std::string anchor = exercise.id;
            std::ranges::replace(anchor, '.', '_');
            text += fmt::format("\\subsection exercise_{} {} {}\n", anchor, exercise.id,
                                exercise.title);
            text +=
                raw(fmt::format("<p class=\"effort\"><span title=\"difficulty {} of 3\">{}</span> "
                                "about {} minutes</p>\n",
                                exercise.difficulty, dots, exercise.minutes));
            text += typeset(exercise.task) + "\n";
            text += fmt::format(
                "Edit `chapters/{}/exercises/{}.hpp`, then run\n\n    ./book exercise check {}\n\n",
                exercise.chapter, exercise.name, exercise.id);
        }
    }
    return text + "*/\n";
}

std::string figures_page(const std::vector<Chapter>& chapters, const std::vector<Figure>& figures) {
    std::string text =
        "/*! \\page figures Figures\n\\tableofcontents{HTML:1}\n"
        "Every figure of the book is made by a program of the book: drawings are the algorithms' "
        "own output, charts "
        "are "
        "drawn from measurements. One command makes figures again:\n\n    ./book figures "
        "1.2 1.3\n    ./book figures 1.2 --dark\n\n"
        "A drawing is an SVG file that follows light and dark pages; with `--dark` or `--light` "
        "its "
        "colours are fixed, for slide programs. A chart comes with its data.\n\n"
        "For the lecture room all figures of a chapter, or some of them, are slides:\n\n"
        "    ./book figures --slides 7\n    ./book figures --slides 3.13 7.17\n\n"
        "makes a web page that needs no other file and no network. Arrow keys, clicks and "
        "fingers lead through a figure's steps, then to the next figure; its first page, the "
        "outline, names the other keys; on paper each figure has a sheet.\n\n";
    for (const Chapter& chapter : chapters) {
        if (std::ranges::count(figures, chapter.folder, &Figure::chapter) == 0) continue;
        text += fmt::format("\\section figures_{} Chapter {}: {}\n\n", chapter.folder,
                            chapter.number, chapter.title);
        for (const Figure& figure : figures) {
            if (figure.chapter != chapter.folder) continue;
            text += fmt::format("\\{}\n", figure.id);
            if (figure.file.empty()) continue;
            const std::string extension = extension_of(figure);
            std::string links =
                fmt::format("<code>{0}</code> {1} <a href=\"{0}.{2}\" download>{3}</a>", figure.id,
                            figure.kind, extension, extension == "svg" ? "SVG" : "PNG");
            if (figure.kind == "chart")
                links += fmt::format(" <a href=\"{}.csv\" download>CSV</a>", figure.id);
            text += raw("<p class=\"figure-links\">" + links + "</p>\n");
        }
    }
    return text + "*/\n";
}

/// A verdict in a sign, a word and (by its class) a colour.
std::string badge(const std::string& verdict) {
    const char* sign = verdict == "confirmed" ? "✓"
                       : verdict == "refuted" ? "✗"
                       : verdict == "depends" ? "◐"
                                              : "○";
    return fmt::format("<span class=\"verdict {}\"><span aria-hidden=\"true\">{}</span> {}</span>",
                       verdict == "no answer yet" ? "open" : verdict, sign, verdict);
}

/// As `chapter` answers it. The first of a claim's chapters has its anchor.
std::string claim_card(const Claim& claim, int chapter, const Answer* answer) {
    const std::string note = claim.note.empty() ? "" : ", " + xml_escaped(claim.note);
    std::string card = fmt::format(
        "<div class=\"claim {}\">\n<p class=\"head\"><b>{}</b> <span>{}{}</span> {}</p>\n<p "
        "class=\"says\">{}</p>\n",
        answer ? answer->verdict : "open", claim.id, source_links({claim.source}), note,
        badge(answer ? answer->verdict : "no answer yet"), typeset(xml_escaped(claim.text)));
    if (answer)
        card += fmt::format(
            "<dl><dt>Measured</dt><dd>{}</dd><dt>Scene</dt><dd>{}</dd><dt>Rule</dt><dd>{}</dd></"
            "dl>\n",
            typeset(xml_escaped(answer->measured)), typeset(xml_escaped(answer->scene)),
            typeset(xml_escaped(answer->rule)));
    const std::string anchor =
        claim.chapters.front() == chapter ? claim.id : fmt::format("{}_{}", claim.id, chapter);
    return fmt::format("\\anchor claim_{}\n{}", anchor, raw(card + "</div>\n"));
}

constexpr const char* ledger_head =
    "/*! \\page ledger Claims and verdicts\n\\tableofcontents{HTML:1}\n"
    "The sources of this book make claims and print numbers. Each chapter's program answers "
    "those that belong to "
    "it "
    "with what it measured, and computes the verdict by a rule that is stated here; no verdict "
    "is typed in. "
    "The sources: \\ref bibliography. Lists by verdict: \\ref ch12_got_right, \\ref "
    "ch12_errata.\n\n";

std::string ledger_page(const Places& places, const std::vector<Chapter>& chapters,
                        const std::vector<Claim>& claims) {
    std::string sections, to_come;
    std::map<std::string, std::string> verdicts;  // of the claims that have one
    for (const Chapter& chapter : chapters) {
        std::vector<const Claim*> mine;
        for (const Claim& claim : claims)
            if (std::ranges::find(claim.chapters, chapter.number) != claim.chapters.end())
                mine.push_back(&claim);
        if (mine.empty()) continue;
        if (!chapter.here) {
            to_come +=
                fmt::format("<tr class=\"group\"><th colspan=\"3\">Chapter {}: {}</th></tr>\n",
                            chapter.number, xml_escaped(chapter.title));
            for (const Claim* claim : mine)
                to_come += fmt::format(
                    "<tr><td id=\"claim_{0}_{1}\">{0}</td><td>{2}{3}{4}</td><td>{5}</td></tr>\n",
                    claim->id, chapter.number, xml_escaped(claim->text),
                    claim->how.empty() ? "" : "; " + xml_escaped(claim->how),
                    claim->note.empty() ? "" : " (" + xml_escaped(claim->note) + ")",
                    source_links({claim->source}));
            continue;
        }
        Answers answers;
        if (const fs::path file = newest_results(places.root, places.runs, chapter.number);
            !file.empty())
            answers = read_answers(file);
        sections += fmt::format("\\section claims_{} Chapter {}: {}\n", chapter.folder,
                                chapter.number, chapter.title);
        sections += raw(fmt::format(
            "<p class=\"machine\">{}</p>\n",
            answers.run.mode.empty()
                ? "Not measured yet."
                : told(answers.run, source_fingerprints(places.root, answers.run.chapter))));
        for (const Claim* claim : mine) {
            const auto answer = std::ranges::find(answers.answers, claim->id, &Answer::claim);
            const bool answered = answer != answers.answers.end();
            if (answered) verdicts[claim->id] = answer->verdict;
            sections += claim_card(*claim, chapter.number, answered ? &*answer : nullptr);
        }
    }
    std::string text = ledger_head;
    std::string tally;
    for (const char* verdict : {"confirmed", "refuted", "depends"})
        tally +=
            fmt::format("<p>{} {}</p>", std::ranges::count(std::views::values(verdicts), verdict),
                        badge(verdict));
    const std::size_t open = claims.size() - verdicts.size();
    text += open == 0
                ? fmt::format("All {} claims are answered.\n\n", claims.size())
                : fmt::format("{} of {} claims are answered.\n\n", verdicts.size(), claims.size());
    text += raw(fmt::format("<div class=\"tally\">{}<p>{} {}</p></div>\n", tally, open,
                            badge("no answer yet")));
    text += sections;
    if (!to_come.empty())
        text += "\\section claims_to_come Chapters to come\n" +
                raw("<div class=\"scroll\"><table class=\"doxtable to-come\">\n" + to_come +
                    "</table></div>\n");
    return text + "*/\n";
}

std::string layout(const Places& places, const std::vector<Chapter>& chapters) {
    const auto tab = [](const std::string& page, const std::string& title) {
        return fmt::format(
            "      <tab type=\"user\" visible=\"yes\" url=\"@ref {}\" title=\"{}\"/>\n", page,
            xml_escaped(title));
    };
    std::string menu;
    const auto text_of_book = [&](const char* file, const char* title) {
        if (const auto page = page_id(places.root / "docs" / file)) menu += tab(*page, title);
    };
    text_of_book("before_you_start.dox", "Before you start");
    text_of_book("cpp20.dox", "The C++20 that the code uses");
    for (const Chapter& chapter : chapters)
        if (const auto page = page_id(places, chapter)) {
            menu += tab(*page, fmt::format("{}. {}", chapter.number, chapter.title));
            for (const fs::path& more : text_files(places.root, chapter) | std::views::drop(1))
                menu +=
                    tab(*page_id(more), fmt::format("{}. {}", chapter.number, page_title(more)));
        }
    menu += tab("exercises", "Exercises") + tab("figures", "Figures") +
            tab("ledger", "Claims and verdicts");
    text_of_book("glossary.dox", "Glossary");
    text_of_book("bibliography.dox", "Bibliography");
    if (exists(places.root / "docs/adding_a_chapter.md"))
        menu += tab("adding_a_chapter", "Adding a chapter");
    return "<doxygenlayout version=\"1.0\">\n  <navindex>\n    <tab type=\"mainpage\" "
           "visible=\"yes\" title=\"The "
           "book\"/>\n" +
           menu +
           "    <tab type=\"usergroup\" visible=\"yes\" url=\"[none]\" title=\"Code\">\n"
           "      <tab type=\"classlist\" visible=\"yes\" title=\"Types\"/>\n"
           "      <tab type=\"concepts\" visible=\"yes\" title=\"Concepts\"/>\n"
           "      <tab type=\"namespacemembers\" visible=\"yes\" title=\"Functions\"/>\n"
           "      <tab type=\"filelist\" visible=\"yes\" title=\"Files\"/>\n"
           "    </tab>\n  </navindex>\n</doxygenlayout>\n";
}

}  // namespace

/// How many claims of each source have which verdict.
static std::string tally_of_claims(const std::vector<ClaimVerdict>& verdicts) {
    constexpr std::array words{"confirmed", "depends", "refuted"};
    std::map<std::string, std::string> of_claim;
    std::map<std::string, std::map<std::string, int>> of_source;
    for (const ClaimVerdict& verdict : verdicts) of_claim[verdict.claim.id] = verdict.verdict;
    std::vector<std::string> sources;  // in the order of claims.json, by their first claim
    for (const ClaimVerdict& verdict : verdicts) {
        const std::string& source = verdict.claim.source;
        if (std::ranges::find(sources, source) == sources.end()) sources.push_back(source);
        if (const auto mine = of_claim.extract(verdict.claim.id))
            ++of_source[source][mine.mapped()];
    }
    const auto row = [&](const std::string& name, const auto& count_of) {
        int all = 0;
        std::string cells;
        for (const char* word : words) {
            all += count_of(word);
            cells += fmt::format("<td>{}</td>", count_of(word));
        }
        const int open = count_of("");
        return fmt::format("<tr><td>{}</td><td>{}</td>{}</tr>\n", name, all + open, cells);
    };
    std::string rows;
    for (const std::string& source : sources)
        rows += row(source_links({source}),
                    [&](const std::string& word) { return of_source[source][word]; });
    rows += row("<b>all</b>", [&](const std::string& word) {
        int sum = 0;
        for (const std::string& source : sources) sum += of_source[source][word];
        return sum;
    });
    std::string head;
    for (const char* word : words) head += fmt::format("<th>{}</th>", badge(word));
    return raw("<table class=\"doxtable\">\n<tr><th>source</th><th>claims</th>" + head + "</tr>\n" +
               rows + "</table>\n");
}

std::string claims_table(const std::vector<ClaimVerdict>& verdicts, const std::string& which) {
    if (which == "tally") return tally_of_claims(verdicts);
    if (which != "confirmed" && which != "refuted" && which != "depends")
        throw input_error(fmt::format("\\claims{{{}}}: expected tally or a verdict", which));
    std::string rows;
    for (const ClaimVerdict& verdict : verdicts) {
        if (verdict.verdict != which) continue;
        const Claim& claim = verdict.claim;
        const std::string anchor = claim.chapters.front() == verdict.chapter
                                       ? claim.id
                                       : fmt::format("{}_{}", claim.id, verdict.chapter);
        rows += fmt::format(
            "<tr><td><a href=\"ledger.html#claim_{}\">{}</a></td><td>{}</td><td>{}</td><td>{}</td>"
            "</tr>\n",
            anchor, claim.id, source_links({claim.source}), typeset(xml_escaped(claim.text)),
            verdict.chapter);
    }
    return raw(
        "<div class=\"scroll\"><table class=\"doxtable\">\n"
        "<tr><th>claim</th><th>source</th><th>says</th><th>chapter</th></tr>\n" +
        rows + "</table></div>\n");
}

/// The texts that people write, docs/*.dox and the chapters', with their measured numbers, with the
/// table of files that the chapter's README.md holds for \\files, and with lists of claims for
/// \\claims{confirmed} and the like.
void write_texts(const Places& places) {
    Measured measured(places.root, places.runs);
    const std::vector<ClaimVerdict> verdicts = read_verdicts(places.root, places.runs);
    static const std::regex files(R"([\\@]files\b)"), claims(R"([\\@]claims\{(\w+)\})");
    const auto write_all = [&](const fs::path& folder) {
        for (const auto& entry : fs::directory_iterator(places.root / folder)) {
            if (entry.path().extension() != ".dox") continue;
            const fs::path name = folder / entry.path().filename();
            std::string text = measured.resolved(read_file(entry.path()), name.string());
            if (std::regex_search(text, files))
                text = std::regex_replace(text, files,
                                          files_table(places.root / folder / "README.md"));
            for (std::smatch at; std::regex_search(text, at, claims);)
                text = at.prefix().str() + claims_table(verdicts, at[1]) + at.suffix().str();
            write_file(places.pages / "texts" / name, text);
        }
    };
    write_all("docs");
    for (const auto& entry : fs::directory_iterator(places.root / "chapters"))
        if (entry.is_directory()) write_all("chapters" / entry.path().filename());
}

std::string figure_aliases(const Places& places) {
    std::string lines;
    for (const Figure& figure : read_figures(places)) {
        const std::string caption = std::regex_replace(figure.caption, std::regex("\""), "\\\"");
        lines +=
            figure.file.empty()
                ? fmt::format("ALIASES += \"{}={}\"\n", figure.id, absent(figure))
                : fmt::format("ALIASES += \"{0}=\\image html {0}.{1} \\\"Figure {2}: {3}\\\"\"\n",
                              figure.id, extension_of(figure), number_of(figure), caption);
    }
    return lines;
}

std::vector<fs::path> text_files(const fs::path& root, const Chapter& chapter) {
    const fs::path folder = root / "chapters" / chapter.folder, first = folder / "chapter.dox";
    std::vector<fs::path> files{first};
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".dox" && entry.path() != first)
            files.push_back(entry.path());
    const std::string text = read_file(first);
    std::ranges::sort(files | std::views::drop(1), {}, [&](const fs::path& file) {
        return std::pair(text.find("\\ref " + *page_id(file)), file);
    });
    return files;
}

std::string figure_order_fault(int chapter, const std::string& text) {
    const std::regex shown(fmt::format(R"([\\@]fig_{:02}_(\d\d)\b)", chapter));
    int count = 0;
    for (std::sregex_iterator at(text.begin(), text.end(), shown), end; at != end; ++at) {
        const int number = std::stoi(at->str(1));
        if (number > count + 1)
            return fmt::format("Figure {0}.{1} is shown where Figure {0}.{2} is due", chapter,
                               number, count + 1);
        count = std::max(count, number);
    }
    return {};
}

std::string files_table(const fs::path& readme) {
    static const std::regex link(R"(\[([^\]]*)\]\(([^)]*)\))");
    std::string table;
    for (const std::string& line : lines_of(read_file(readme))) {
        if (table.empty() && line != "| Read | for |") continue;
        if (!line.starts_with('|')) break;
        for (std::sregex_iterator at(line.begin(), line.end(), link), end; at != end; ++at)
            if (!exists(readme.parent_path() / at->str(2)))
                throw input_error(
                    fmt::format("{}: there is no file {}", readme.string(), at->str(2)));
        if (!line.starts_with("| [chapter.dox]"))
            table += std::regex_replace(line, link, "`$1`") + "\n";
    }
    if (table.empty())
        throw input_error(fmt::format("{}: no table \"| Read | for |\"", readme.string()));
    return table;
}

void write_pages(const Places& places) {
    const auto chapters = read_chapters(places.root);
    const auto claims = read_claims(places.root / "docs/claims.json");
    const auto figures = read_figures(places);
    const auto exercises = read_exercises(places);
    const auto write = [&](const char* name, const std::string& text) {
        write_file(places.pages / name, text);
    };
    write("chapter_table.inc", chapter_table(places, chapters, figures, exercises, claims));
    write("exercises.dox", exercises_page(chapters, exercises));
    write("figures.dox", figures_page(chapters, figures));
    write("ledger.dox", ledger_page(places, chapters, claims));
    write("layout.xml", layout(places, chapters));
    write_texts(places);
    for (const Figure& figure : figures) {
        if (figure.file.empty()) continue;
        write_file(places.pages / "images" / figure.file.filename(), read_file(figure.file));
        const fs::path data = fs::path(figure.file).replace_extension(".csv");
        if (figure.kind == "chart" && exists(data))
            write_file(places.pages / "data" / data.filename(), read_file(data));
    }
}

}  // namespace space::docs
