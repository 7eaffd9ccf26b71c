/// Makes the book as a web site: writes the generated pages, runs Doxygen, finishes its pages, adds
/// MathJax. Run   make_site --out build/book/site
#include "common/program/base64.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/options.hpp"
#include "docs/finish.hpp"
#include "docs/pages.hpp"
#include "docs/search_text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <sys/wait.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using namespace space;

/// The part of MathJax that turns the book's formulas into SVG: 3 of 54 MB.
void copy_mathjax(const fs::path& from, const fs::path& to) {
    constexpr std::array parts{"MathJax.js",
                               "config/TeX-AMS_SVG-full.js",
                               "jax/element/mml",
                               "jax/output/SVG/config.js",
                               "jax/output/SVG/jax.js",
                               "jax/output/SVG/autoload",
                               "jax/output/SVG/fonts/TeX"};
    for (const char* part : parts) {
        fs::create_directories((to / part).parent_path());
        fs::copy(from / part, to / part, fs::copy_options::recursive);
    }
}

/// The settings for Doxygen: the configured Doxyfile, which leaves the output to be named here.
void write_doxyfile(const docs::Places& places, const std::string& aliases,
                    const fs::path& output) {
    const fs::path& work = places.pages;
    std::string settings =
        read_file(fs::path(BOOK_DOXYFILE)) + docs::figure_aliases(places) + aliases +
        fmt::format(
            "LAYOUT_FILE = \"{0}/layout.xml\"\n"
            "STRIP_FROM_PATH = \"{0}/texts\" \"{2}\"\nEXAMPLE_PATH += \"{0}\"\n"
            "IMAGE_PATH = \"{0}/images\"\nOUTPUT_DIRECTORY = \"{1}\"\nHTML_OUTPUT = .\n",
            work.string(), output.string(), book_root().string());
    // Each text by its name: patterns, which could leave out the texts as they were written, fail
    // in a folder with an umlaut.
    std::set<fs::path> texts;
    for (const auto& entry : fs::recursive_directory_iterator(work))
        if (entry.path().extension() == ".dox") texts.insert(entry.path());
    for (const fs::path& text : texts) settings += fmt::format("INPUT += \"{}\"\n", text.string());
    write_file(work / "Doxyfile", settings);
}

void run_doxygen(const fs::path& doxyfile, const fs::path& output) {
    fs::remove_all(output);
    fs::create_directories(output);
    const std::string command = fmt::format("\"{}\" \"{}\"", BOOK_DOXYGEN, doxyfile.string());
    const int status = std::system(command.c_str());
    constexpr int interrupted = 128 + SIGINT;  // a shell's word for it
    if (WIFSIGNALED(status) ? WTERMSIG(status) == SIGINT : WEXITSTATUS(status) == interrupted)
        std::raise(SIGINT);  // which std::system kept from us
    if (status != 0) throw input_error("Doxygen has warnings or failed; its lines above say where");
}

/// The live figures and the module that draws them; none where it was not built.
struct Live {
    std::vector<std::string> ids = {};
    std::string module = {};
};

Live read_live() {
    const fs::path module = BOOK_LIVE_MODULE;
    if (module.empty()) return {};
    const std::string list = read_file(book_root() / "docs/live/figures.cpp");
    static const std::regex entry(R"re(\{"(\w+)",\s*\w+\})re");
    Live live{.module = read_file(module)};
    for (std::sregex_iterator at(list.begin(), list.end(), entry), end; at != end; ++at)
        live.ids.push_back(at->str(1));
    return live;
}

/// What \\live_figures in a page stands for.
std::string live_alias(const Live& live) {
    if (live.ids.empty()) return "ALIASES += \"live_figures=\"\n";
    return fmt::format(
        "ALIASES += \"live_figures={} figures are live: press <b>Move it yourself</b> and drag "
        "their points, by mouse, finger or arrow keys; the book's own C++ draws them again. It is "
        "in a module of {:.2f} MB beside these pages, and needs no network. What you have made "
        "stands in the page's address, as a link to share, and can be saved as an SVG file.\"\n",
        live.ids.size(), static_cast<double>(live.module.size()) * 1e-6);
}

/// The module goes into the site as a script that holds its bytes: a page that was opened from a
/// file may load no other.
void add_live(const Live& live, const fs::path& site) {
    if (live.ids.empty()) return;
    write_file(site / "live_module.js",
               fmt::format("window.bookModule = \"{}\";\n", base64(live.module)));
    for (const char* part : {"live.js", "live.css"})
        fs::copy_file(book_root() / "docs/live" / part, site / part);
}

int make_site(int argc, char** argv) {
    docs::Places places{.root = book_root(),
                        .configured = BOOK_CONFIGURED,
                        .runs = book_root() / "build/book",
                        .pages = {}};
    fs::path site = places.configured / "site";
    CLI::App app("Makes the book as a web site that opens from a local file.", "make_site");
    app.add_option("--out", site, "folder of the site; replaced as a whole")->capture_default_str();
    app.add_option(
           "--runs", places.runs,
           "what ./book run wrote; newer figures and results than the committed ones are shown")
        ->capture_default_str();
    bool again = false;
    app.add_flag(
        "--again", again,
        "take what Doxygen made the last time; a test sees that all else is made the same");
    parse_command_line(app, argc, argv);

    // Everything is made beside the old site, which stands until the new one is whole.
    site = fs::absolute(site);
    const fs::path work = places.configured / "site_pages",
                   doxygens = places.configured / "site_doxygen", fresh = site.string() + ".new";
    fs::remove_all(work);
    fs::remove_all(fresh);
    places.pages = work;
    docs::write_pages(places);
    const Live live = read_live();
    write_doxyfile(places, live_alias(live), doxygens);
    if (!again) run_doxygen(work / "Doxyfile", doxygens);
    fs::copy(doxygens, fresh, fs::copy_options::recursive);
    docs::finish_pages(fresh, live.ids);
    add_live(live, fresh);
    docs::write_search_text(fresh);
    copy_mathjax(BOOK_MATHJAX, fresh / "mathjax");
    if (exists(work / "data")) fs::copy(work / "data", fresh);
    fs::remove_all(site);
    fs::rename(fresh, site);
    fmt::print("{}\n", (site / "index.html").string());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return space::run_program("make_site", make_site, argc, argv);
}
