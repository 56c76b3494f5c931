#include "tests/support/iso_surface.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <vtkCellArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

namespace vesselbench::test {

Surface iso_surface(const ImplicitShape& shape, const Eigen::AlignedBox3d& box, double cell) {
    vtkNew<vtkImageData> image;
    int n[3];
    for (int a = 0; a < 3; ++a) n[a] = static_cast<int>(std::ceil(box.sizes()[a] / cell)) + 1;
    image->SetDimensions(n);
    image->SetSpacing(cell, cell, cell);
    image->SetOrigin(box.min().data());
    image->AllocateScalars(VTK_DOUBLE, 1);
    auto* value = static_cast<double*>(image->GetScalarPointer());
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i) *value++ = shape(box.min() + cell * Vec3(i, j, k));
    vtkNew<vtkFlyingEdges3D> edges;
    edges->SetInputData(image);
    edges->SetValue(0, 0.0);
    edges->ComputeNormalsOff();
    edges->Update();
    vtkPolyData* found = edges->GetOutput();
    Positions points(static_cast<std::size_t>(found->GetNumberOfPoints()));
    for (std::size_t i = 0; i < points.size(); ++i)
        found->GetPoint(static_cast<vtkIdType>(i), points[i].data());
    std::vector<Triangle> triangles;
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    for (found->GetPolys()->InitTraversal(); found->GetPolys()->GetNextCell(count, ids) != 0;)
        triangles.push_back({static_cast<VertexId>(ids[0]), static_cast<VertexId>(ids[1]),
                             static_cast<VertexId>(ids[2])});
    return make_surface(std::move(points), std::move(triangles));
}

double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double radius) {
    const Vec3 d = b - a;
    const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    return (p - a - t * d).norm() - radius;
}

Surface with_noise(const Surface& surface, double amount) {
    double sum = 0.0;
    for (const Triangle& t : surface.triangles())
        for (std::size_t k = 0; k < 3; ++k)
            sum += (surface.points()[t[k]] - surface.points()[t[(k + 1) % 3]]).norm();
    const double edge = sum / (3.0 * static_cast<double>(surface.triangle_count()));
    std::mt19937 random(7);
    Positions moved = surface.points();
    for (Vec3& p : moved)
        for (int a = 0; a < 3; ++a) {
            // Twelve uniform deviates: nearly normal, and the same with every standard library.
            double deviate = -6.0;
            for (int k = 0; k < 12; ++k) deviate += static_cast<double>(random()) / 4294967296.0;
            p[a] += amount * edge * deviate;
        }
    return surface.with_positions(std::move(moved));
}

}  // namespace vesselbench::test
