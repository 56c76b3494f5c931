#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vesselbench {

/// An element of a VTK XML file.
struct VtkXmlElement {
    std::string name;
    std::map<std::string, std::string> attributes;
    std::size_t offset = 0;             ///< of its '<' in the file [bytes]
    std::optional<std::size_t> parent;  ///< index of the element around it; none: the root
};

/// The elements of a VTK XML file in their order, the root first. The file is XML up to the end, or
/// up to the tag `<AppendedData`, whose element is the last. VTK's own parser finds them: VTK sees
/// no others.
/// \param name the file's name without its folder
/// \throw InvalidInput if the XML is not well-formed, is no VTK file or ends before it does, is
/// UTF-16 or UTF-32, declares a document type or entities, or has more elements than surfaces and
/// images have
[[nodiscard]] std::vector<VtkXmlElement> vtk_xml_elements(std::string_view bytes,
                                                          const std::string& name);

/// The value of an attribute; nothing if the element has none of that name.
[[nodiscard]] std::optional<std::string_view> attribute(const VtkXmlElement& element,
                                                        const std::string& key);

}  // namespace vesselbench
