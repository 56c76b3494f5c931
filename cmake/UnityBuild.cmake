# The sanitizers' presets compile several sources of a target at once (CMAKE_UNITY_BUILD): reading headers is most of
# their time. These sources have helpers whose names a neighbour's helpers have too, or headers that stand no second
# reading; they are compiled apart: compile_apart(TARGET FOLDER SOURCE...), sources without .cpp.
function(compile_apart target folder)
  set(sources ${ARGN})
  list(TRANSFORM sources PREPEND ${CMAKE_SOURCE_DIR}/${folder}/)
  list(TRANSFORM sources APPEND .cpp)
  foreach(source IN LISTS sources)
    if(NOT EXISTS ${source})
      message(FATAL_ERROR "cmake/UnityBuild.cmake names ${source}, which is not there")
    endif()
  endforeach()
  set_source_files_properties(${sources} TARGET_DIRECTORY ${target} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

compile_apart(vb_kernel geometry/kernel one_rings vertex_corners)
compile_apart(vb_image geometry/image histogram resample)
compile_apart(vb_editing geometry/editing flat_cap)
compile_apart(vb_vessel geometry/vessel centerlines/strands centerlines/thin_vessels openings/cut_trial
  openings/extrude openings/frayed_trunks openings/opening_axis openings/planned_cut ends/end_choice ends/end_odds
  ends/end_profile ends/flat_faces ends/flow_tree ends/patch_shape ends/stub_lines ends/stub_sections ends/surface_ends
  openings/vessel_tube openings/wall_axis repair/sheets repair/soup repair/stray_holes)
compile_apart(vb_formats geometry/formats legacy_vtk meta_image nifti nrrd obj off ply vtk_xml_check)
compile_apart(vb_filters smoothing/filters sweep_schedule)
compile_apart(vb_context smoothing/context cap_border normal_peaks staircase_weights)
compile_apart(vb_quality smoothing/quality sensitivity)
compile_apart(vb_tetrahedra meshing/tetrahedra tetgen_guard)
compile_apart(vb_remeshing meshing/remeshing decimate decimater surface_walk)
compile_apart(vb_prepare workbench/prepare before_cuts end_settings refusal_report)
compile_apart(vesselbench workbench/commands ends end_picture)
compile_apart(vb_project workbench/project part_store schema)
if(VESSELBENCH_TESTS)
  compile_apart(test_geometry tests/geometry centerlines_test editable_surface_test end_choice_test extract_surface_test
    extrude_test formats_test good_rims_test openings_test phantom_test remove_branch_test thin_vessels_test)
  compile_apart(test_smoothing tests/smoothing filters_test staircases_as_printed_test staircases_test)
  compile_apart(test_meshing tests/meshing tetrahedralize_test)
  compile_apart(test_session tests/session history_test hostile_project_test project_test worker_test)
endif()
