// Half of the section of a bolted stack, x = r and y = z, in mm: two plates and a bolt with a head.
//   gmsh -2 -format msh41 bolted_stack_axisymmetric.geo
SetFactory("OpenCASCADE");
shank = 5; head = 8; hole = 5.5; rim = 15; plate = 10; thick = 6;
Rectangle(1) = {hole, 0, 0, rim - hole, plate};
Rectangle(2) = {hole, plate, 0, rim - hole, plate};
Rectangle(3) = {0, 0, 0, shank, 2*plate};
Rectangle(4) = {0, 2*plate, 0, head, thick};
BooleanUnion(5) = { Surface{3}; Delete; }{ Surface{4}; Delete; };
Physical Surface("lower plate") = {1};
Physical Surface("upper plate") = {2};
Physical Surface("bolt") = {5};
Mesh.MeshSizeMax = 1;
Mesh.ElementOrder = 2;
