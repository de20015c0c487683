// A bush pressed into a round lug, too large by i; a quarter. Lengths in mm.
//   gmsh -3 press_bush.geo -o press_bush.msh
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
DefineConstant[ h = 2.5 ];
DefineConstant[ i = 0.02 ];    // interference of the radii
Mesh.MeshSizeMin = h/2; Mesh.MeshSizeMax = h;
Cylinder(1) = {0,0,0, 0,0,10, 24, Pi/2};
Cylinder(2) = {0,0,-1, 0,0,12, 12, Pi/2};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(11) = {0,0,-3, 0,0,16, 12+i, Pi/2};
Cylinder(12) = {0,0,-4, 0,0,18, 8, Pi/2};
BooleanDifference(13) = { Volume{11}; Delete; }{ Volume{12}; Delete; };
Physical Volume("lug") = {3};
Physical Volume("bush") = {13};
e = 0.001;
Physical Surface("rim") = Surface In BoundingBox {-e,-e,-e, 24+e,24+e,e};
Physical Surface("pushed") = Surface In BoundingBox {-e,-e,13-e, 13,13,13+e};
Physical Surface("plane x") = Surface In BoundingBox {-e,-e,-4, e,25,14};
Physical Surface("plane y") = Surface In BoundingBox {-e,-e,-4, 25,e,14};
// What follows names surfaces that touch, for CalculiX alone: Mortise finds them.
Physical Surface("hole") = Surface In BoundingBox {-e,-e,-e, 12+e,12+e,10+e};
Physical Surface("outside of the bush") = Surface In BoundingBox {-e,-e,-3-e, 12+i+e,12+i+e,13+e};
