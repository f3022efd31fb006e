# SPDX-License-Identifier: BSD-3-Clause
# Every other module uses base.
occusg_add_module(base
  SOURCES
    parameter.cpp)

occusg_add_module(geometry
  SOURCES
    cell_outline.cpp
    edge_contacts.cpp
    polygon.cpp
    polygon_overlap.cpp
    polygon_validity.cpp
    pose.cpp
  LIBRARIES CGAL::CGAL Polyclipping::Polyclipping
  ALONE polygon_overlap.cpp)

occusg_add_module(perception
  SOURCES
    camera_model.cpp
    class_names.cpp
    depth_projector.cpp
    detection_builder.cpp
    euclidean_cluster.cpp
    label_image.cpp
    letterbox.cpp
    map_orientation.cpp
    onnx_segmenter.cpp
    onnx_signature.cpp
    perception_parameters.cpp
    pose_gate.cpp
    range_image.cpp
    yolo_output.cpp
  USES geometry
  LIBRARIES opencv_core opencv_imgproc opencv_dnn PclClustering::PclClustering)

occusg_add_module(mapping
  SOURCES
    ceiling.cpp
    column_bits.cpp
    depth_bounds.cpp
    far_islands.cpp
    frame_carver.cpp
    frame_rays.cpp
    frame_voxels.cpp
    free_space_cells.cpp
    free_space_layer.cpp
    free_space_projection.cpp
    lattice_projection.cpp
    layer_without_rays.cpp
    local_floor.cpp
    mapping_parameters.cpp
    measured_evidence.cpp
    occupancy_map.cpp
    occupancy_thresholds.cpp
    settled_voxels.cpp
    storey_finder.cpp
    storeys.cpp
    tree_writer.cpp
    voxel_columns.cpp
    voxel_tree.cpp
    workers.cpp
  USES geometry perception
  LIBRARIES occusg_octomap Threads::Threads
  ALONE frame_rays.cpp)

# The dual-space decomposition needs CGAL's 2D triangulations and hulls, which are GPL-3.0-or-later.
if(OCCUSG_WITH_DUDE)
  set(dude_sources
    dude_candidates.cpp
    dude_clearance.cpp
    dude_decomposer.cpp
    dude_division.cpp
    dude_holes.cpp
    dude_mask.cpp
    dude_mesh.cpp
    dude_partition.cpp
    dude_pieces.cpp
    dude_pockets.cpp
    dude_regions.cpp
    dude_selection.cpp
    dude_symmetry.cpp
    dude_trace.cpp)
  set(dude_libraries CGAL::CGAL)
else()
  set(dude_sources without_dude.cpp)
  set(dude_libraries "")
endif()
occusg_add_module(regions
  SOURCES
    ${dude_sources}
    acceptance_guard.cpp
    basin_regions.cpp
    basins.cpp
    cell_sums.cpp
    clearance.cpp
    constriction_decomposer.cpp
    constriction_division.cpp
    contacts.cpp
    crossings.cpp
    free_patches.cpp
    free_pieces.cpp
    label_regions.cpp
    lintels.cpp
    low_ceilings.cpp
    no_rooms.cpp
    outside.cpp
    passages.cpp
    region_tracker.cpp
    regions_parameters.cpp
    side_corridors.cpp
    small_pieces.cpp
    squared_distance.cpp
    straight_cuts.cpp
  USES geometry mapping
  LIBRARIES ${dude_libraries} opencv_core opencv_imgproc)

occusg_add_module(graph
  SOURCES
    adjacency_layer.cpp
    agent_layer.cpp
    change_log.cpp
    class_key.cpp
    door_layer.cpp
    drivable_path.cpp
    entity_assignment.cpp
    free_space_links.cpp
    ghost_check.cpp
    graph_builder.cpp
    graph_parameters.cpp
    graph_query.cpp
    interior_point.cpp
    navigation_block.cpp
    navigation_layer.cpp
    node_table.cpp
    object_layer.cpp
    printable.cpp
    region_joins.cpp
    region_snapshot.cpp
    relinking.cpp
    room_completeness.cpp
    room_history.cpp
    room_labels.cpp
    room_layer.cpp
    scene_graph.cpp
    seen_apart.cpp
    spatial_index.cpp
  USES geometry perception mapping regions
  ALONE room_labels.cpp)

occusg_add_module(pipeline
  SOURCES
    building_graph.cpp
    building_pipeline.cpp
    config.cpp
    config_file.cpp
    frame_report.cpp
    map_pipeline.cpp
    pipeline.cpp
    room_pipeline.cpp
    stage_times.cpp
  USES geometry perception mapping regions graph
  LIBRARIES yaml-cpp)

occusg_add_module(io
  SOURCES
    building_json.cpp
    canvas.cpp
    color_image.cpp
    decomposition_drawing.cpp
    external_rooms.cpp
    file_bytes.cpp
    file_mark.cpp
    findings_picture.cpp
    folder_exchange.cpp
    graph_json.cpp
    graphml_file.cpp
    house_file.cpp
    json_text.cpp
    label_picture.cpp
    label_placement.cpp
    map_drawing.cpp
    map_files.cpp
    map_picture.cpp
    map_reader.cpp
    map_values.cpp
    map_yaml.cpp
    node_json.cpp
    object_labels.cpp
    object_records.cpp
    occusg_1_0_file.cpp
    octomap_file.cpp
    octomap_scan.cpp
    output_folder.cpp
    overview_graph.cpp
    overview_labels.cpp
    overview_picture.cpp
    overview_view.cpp
    part_file.cpp
    png_check.cpp
    picture_size.cpp
    polygon_json.cpp
    portable_map.cpp
    result_index.cpp
    results.cpp
    recordings/camera_file.cpp
    recordings/folder_names.cpp
    recordings/numbered_recordings.cpp
    recordings/recording.cpp
    recordings/rtabmap_recording.cpp
    recordings/trajectory_file.cpp
    recordings/tum_recording.cpp
    room_color.cpp
    room_labels_file.cpp
    rooms_file.cpp
    rooms_geojson.cpp
    scene_graph_file.cpp
    scene_graph_reader.cpp
    sequence_reader.cpp
    session_folder.cpp
    session_json.cpp
    session_repair.cpp
    spark_dsg_file.cpp
    storeys_picture.cpp
    text_lines.cpp
  USES geometry perception mapping regions graph pipeline
  LIBRARIES nlohmann_json::nlohmann_json yaml-cpp opencv_core opencv_imgproc opencv_imgcodecs
  ALONE node_json.cpp object_labels.cpp scene_graph_file.cpp)

occusg_add_module(evaluation
  SOURCES
    alignment.cpp
    assignment.cpp
    boundary_f1.cpp
    evaluated_room.cpp
    metrics_json.cpp
    observed_rooms.cpp
    relation_metrics.cpp
    room_metrics.cpp
    room_metrics_mean.cpp
    score_estimates.cpp
    truth_check.cpp
  USES geometry
  LIBRARIES nlohmann_json::nlohmann_json opencv_core opencv_imgproc
  ALONE room_metrics.cpp)

occusg_add_module(report
  SOURCES
    companion_tables.cpp
    html_text.cpp
    report_cells.cpp
    report_page.cpp
    report_pictures.cpp
    report_tables.cpp
    results_files.cpp
    room_drawing.cpp
    scene_folder.cpp
    scene_result.cpp
  USES geometry perception mapping regions graph pipeline io evaluation
  LIBRARIES nlohmann_json::nlohmann_json)
