// A quarter of two plates and a bolt with a head, in mm; z = 0 is a plane of symmetry too.
//   gmsh -3 -format msh41 bolted_stack.geo
SetFactory("OpenCASCADE");
shank = 5; head = 8; hole = 5.5; rim = 15; plate = 10; thick = 6;
Cylinder(1) = {0, 0, 0, 0, 0, plate, rim, Pi/2};
Cylinder(2) = {0, 0, 0, 0, 0, plate, hole, Pi/2};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0, 0, plate, 0, 0, plate, rim, Pi/2};
Cylinder(5) = {0, 0, plate, 0, 0, plate, hole, Pi/2};
BooleanDifference(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };
Cylinder(7) = {0, 0, 0, 0, 0, 2*plate, shank, Pi/2};
Cylinder(8) = {0, 0, 2*plate, 0, 0, thick, head, Pi/2};
BooleanUnion(9) = { Volume{7}; Delete; }{ Volume{8}; Delete; };
Physical Volume("lower plate") = {3};
Physical Volume("upper plate") = {6};
Physical Volume("bolt") = {9};
Mesh.MeshSizeMax = 3;
Mesh.ElementOrder = 2;
