#include "geometry/formats/vtk_xml_elements.h"

#include <algorithm>

#include <vtkCommand.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLParser.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

/// Files of our formats have a few hundred; VTK keeps far more memory for an element than it has
/// bytes, and its destructors call themselves for each level.
constexpr std::size_t kMostElements = 100'000;
constexpr std::size_t kDeepestElement = 64;

/// VTK takes the first of these for the end of the XML, wherever it is.
constexpr std::string_view kAppended = "<AppendedData";

/// Ignores the parser's complaints, which it would print.
class Silence : public vtkCommand {
public:
    static Silence* New() { return new Silence; }

    void Execute(vtkObject* /*caller*/, unsigned long /*event*/, void* /*data*/) override {}
};

/// Records the elements that VTK's parser finds.
class ElementReader : public vtkXMLParser {
public:
    static ElementReader* New();
    vtkTypeMacro(ElementReader, vtkXMLParser);

    /// False if the text cannot follow what was parsed so far.
    bool parse(std::string_view text) {
        constexpr std::size_t kPiece = std::size_t{1} << 20;
        while (!text.empty()) {
            const std::size_t size = std::min(text.size(), kPiece);
            if (ParseChunk(text.data(), static_cast<unsigned int>(size)) == 0 || too_many_)
                return false;
            text.remove_prefix(size);
        }
        return true;
    }

    std::vector<VtkXmlElement> elements;

protected:
    ElementReader() { SetIgnoreCharacterData(1); }

    void StartElement(const char* name, const char** attributes) override {
        too_many_ = too_many_ || elements.size() == kMostElements || open_.size() > kDeepestElement;
        if (too_many_) return;
        VtkXmlElement element{.name = name, .offset = static_cast<std::size_t>(GetXMLByteIndex())};
        if (!open_.empty()) element.parent = open_.back();
        for (; attributes[0] != nullptr && attributes[1] != nullptr; attributes += 2)
            element.attributes[attributes[0]] = attributes[1];
        open_.push_back(elements.size());
        elements.push_back(std::move(element));
    }

    void EndElement(const char* /*name*/) override {
        if (!too_many_) open_.pop_back();
    }

private:
    std::vector<std::size_t> open_;
    bool too_many_ = false;
};

vtkStandardNewMacro(ElementReader);

/// Entities can hold elements, and in wide characters tags cannot be found among the bytes.
void refuse_hidden_elements(std::string_view xml, const std::string& name) {
    if (xml.starts_with("\xfe\xff") || xml.starts_with("\xff\xfe") ||
        xml.find('\0') != std::string_view::npos)
        throw InvalidInput(name + " is UTF-16 or UTF-32 text or damaged: save it as UTF-8");
    for (const std::string_view declaration : {"<!DOCTYPE", "<!ENTITY"})
        if (xml.find(declaration) != std::string_view::npos)
            throw InvalidInput(name + " contains " + std::string(declaration) +
                               ", which VTK files do not have: write it again with the program "
                               "that it comes from");
}

void require_both_ends(std::string_view bytes, const std::string& name) {
    if (bytes.find("<VTKFile") == std::string_view::npos)
        throw InvalidInput(name + " is not a VTK XML file: '<VTKFile' is missing");
    if (bytes.rfind("</VTKFile>") == std::string_view::npos)
        throw InvalidInput(
            name + " ends without '</VTKFile>': it is truncated; copy or download it again");
}

/// The text that VTK puts in place of the appended data. \param xml up to the '>' of their tag
std::string artificial_end(std::string_view xml) {
    return std::string(xml.ends_with('/') ? ">" : "/>") + "\n</VTKFile>\n";
}

}  // namespace

std::vector<VtkXmlElement> vtk_xml_elements(std::string_view bytes, const std::string& name) {
    const auto appended = bytes.find(kAppended);
    const bool has_appended = appended != std::string_view::npos;
    const std::string_view xml =
        bytes.substr(0, has_appended ? bytes.find('>', appended) : std::string_view::npos);
    refuse_hidden_elements(xml, name);
    require_both_ends(bytes, name);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkNew<ElementReader> reader;
    vtkNew<Silence> silence;
    reader->AddObserver(vtkCommand::ErrorEvent, silence.Get());
    reader->AddObserver(vtkCommand::WarningEvent, silence.Get());
    reader->InitializeParser();
    const bool read = reader->parse(xml) && (!has_appended || reader->parse(artificial_end(xml)));
    // A tag of appended data within a comment or a value: VTK would go on reading behind it.
    const bool ended = reader->CleanupParser() != 0 && read && !reader->elements.empty() &&
                       (!has_appended || reader->elements.back().name == kAppended.substr(1));
    if (!ended) throw InvalidInput(name + ": its XML is damaged; copy or download it again");
    if (reader->elements.front().name != "VTKFile")
        throw InvalidInput(name + " is not a VTK XML file: its root is not '<VTKFile'");
    return std::move(reader->elements);
}

std::optional<std::string_view> attribute(const VtkXmlElement& element, const std::string& key) {
    const auto found = element.attributes.find(key);
    if (found == element.attributes.end()) return std::nullopt;
    return found->second;
}

}  // namespace vesselbench
