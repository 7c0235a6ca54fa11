"""Tests of other_api.py on a few lines of headers."""

import unittest

import other_api

OF_6 = {
    "sundials/sundials_types.h": "typedef double realtype;\ntypedef double sunrealtype;\n#define booleantype int\n",
    "sundials/sundials_nonlinearsolver.h": "#define SUN_NLS_SUCCESS 0\n",
    "sundials/sundials_context.h": "SUNDIALS_EXPORT int SUNContext_SetLogger(SUNContext sunctx, SUNLogger logger);\n",
    "kinsol/kinsol.h": "SUNDIALS_EXPORT int KINSetErrFile(void *kinmem,\n  FILE *errfp);\nint KINSetUserData(void*);\n",
    "arkode/arkode_mristep.h": "int MRIStepEvolve(void*);\nint MRIStepSetCoupling(void*);\n",
}


class Converted(unittest.TestCase):
    def test_Headers_OfSix_LoseTheNamesThatSevenHasNot(self):
        headers = other_api.converted(OF_6, "7")
        text = "".join(headers.values())
        for gone in (" realtype", " booleantype", "SUN_NLS_SUCCESS", "KINSetErrFile", "MRIStepEvolve"):
            self.assertNotIn(gone, text)
        for there in ("ARKodeEvolve(", "MRIStepSetCoupling(", "KINSetUserData", "SUNContext_ClearErrHandlers"):
            self.assertIn(there, text)

    def test_Headers_OfAnotherSundials_AreRefused(self):
        for to in other_api.CHANGES:
            with self.assertRaisesRegex(ValueError, "nothing in .* matches"):
                other_api.converted({"sundials/sundials_types.h": "typedef double sunrealtype;\n"}, to)


if __name__ == "__main__":
    unittest.main()
