// A bracket on a base, held down by a washer. Lengths in mm. Meshed by
//   gmsh -3 bracket.geo -o bracket.msh
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.MeshSizeMin = 7;
Mesh.MeshSizeMax = 10;
Mesh.MshFileVersion = 4.1;

// The bracket: a foot with a hole, and a wall.
Box(1) = {0, 0, 0, 60, 40, 8};
Box(2) = {0, 0, 0, 8, 40, 40};
Cylinder(3) = {38, 20, -1, 0, 0, 10, 6};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
BooleanDifference(5) = { Volume{4}; Delete; }{ Volume{3}; Delete; };

// The base under it, and the washer on its foot.
Box(6) = {-10, -10, -10, 80, 60, 10};
Cylinder(7) = {38, 20, 8, 0, 0, 4, 11};
Cylinder(8) = {38, 20, 7, 0, 0, 6, 6};
BooleanDifference(9) = { Volume{7}; Delete; }{ Volume{8}; Delete; };

// Names for bodies, and for the surfaces that are fixed or pushed. Where parts touch no name is needed.
Physical Volume("bracket") = {5};
Physical Volume("base") = {6};
Physical Volume("washer") = {9};
e = 0.01;
Physical Surface("floor") = Surface In BoundingBox {-10 - e, -10 - e, -10 - e, 70 + e, 50 + e, -10 + e};
Physical Surface("bolt") = Surface In BoundingBox {0, 0, 12 - e, 60, 40, 12 + e};
Physical Surface("wall") = Surface In BoundingBox {-e, -e, -e, e, 40 + e, 40 + e};
